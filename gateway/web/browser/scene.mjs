// SPDX-License-Identifier: Apache-2.0
// The 3D view: loaded when it is opened, grows with the executed path, draws nothing for a hidden tab. Its frame rate with
// 200,000 segments is printed, not judged: it depends on the computer, and here no graphics card draws.
import { channelState, check, drawn, eventually, interceptStream, openPage, post, pretend, settled, shot, streamed } from "./harness.mjs";

const frames = (page) => page.locator("[data-test=scene]").evaluate((canvas) => Number(canvas.dataset.frames ?? 0));
const segments = (page) => page.locator("[data-test=scene]").evaluate((canvas) => Number(canvas.dataset.segments ?? 0));
const open = async (page) => {
  await page.getByRole("button", { name: "3D", exact: true }).first().click();
  await page.locator("[data-test=segments]").waitFor();
};

async function select(url, program) {
  await post(url, "channels/0/mode", { mode: "AUTO" });
  await eventually(`${program} is selected`, async () => (await post(url, "channels/0/select", { program })).ok);
  await eventually(`${program} is shown`, async () => (await channelState(url)).program === program);
}

/** Gives the cycle of the start. */
async function run(url, program) {
  await select(url, program);
  const started = await eventually("the program starts", () => post(url, "channels/0/cycle-start"), (answer) => answer.ok);
  return (await started.json()).cycle;
}

/** What was started in a cycle has ended; a state of before has no later one. */
const ends = (url, start) =>
  eventually(`the program that was started in cycle ${start} has ended`, () => channelState(url), ({ state, cycle }) => state === "IDLE" && cycle > start);

/** Shows the machine as a key of the view says, and gives back when it is drawn. */
async function look(page, name) {
  const before = await frames(page);
  await page.getByRole("button", { name, exact: true }).click();
  await eventually(`the view ${name} is drawn`, () => frames(page), (count) => count > before);
  await drawn(page);
}

const shownSeconds = async (page) => (await page.locator("[data-test=remaining]").innerText()).split(":").reduce((sum, part) => 60 * sum + Number(part), 0);
/** Of the cone, whole ones: other parts of the test may have changed parameters. */
const plannedSeconds = async (url) => Math.floor((await fetch(`${url}api/programs/nas979_cone.nc/plan`).then((answer) => answer.json())).seconds);

/** At a small override the program takes long enough to be watched in virtual time; its rapids are as fast as ever. */
async function remainingTime(page, url) {
  const seconds = () => shownSeconds(page);
  await select(url, "nas979_cone.nc");
  const planned = await plannedSeconds(url);
  await eventually(`the cone is planned: ${planned} s`, seconds, (shown) => shown === planned);
  await post(url, "channels/0/override", { kind: "feed", value: 0.002 });
  await run(url, "nas979_cone.nc");
  await eventually("it runs", async () => (await channelState(url)).state === "RUNNING");
  const different = [];
  await eventually(() => `four times are shown while it runs: ${different}`, async () => {
    const left = await seconds();
    if (left !== different[different.length - 1]) different.push(left);
    return different.length >= 5 || (await channelState(url)).state === "IDLE";
  });
  check(`the remaining time counts down: ${different}`, different.length > 2 && different.every((one, i) => i === 0 || one < different[i - 1]));
  await post(url, "channels/0/reset");
  await post(url, "channels/0/override", { kind: "feed", value: 1 });
  await eventually(`all of it is planned again: ${planned} s`, seconds, (shown) => shown === planned);
}

async function growing(browser, url) {
  const page = await openPage(browser, null);
  const requested = [];
  page.on("request", (request) => requested.push(request.url()));
  await page.goto(url);
  await page.waitForSelector(".positions");
  await streamed(page, 5);
  await settled(page);
  const bytes = (await Promise.all(requested.filter((one) => /\.(js|css|html)$|\/$/.test(one)).map((one) => fetch(one).then((r) => r.arrayBuffer())))).map((b) => b.byteLength);
  console.log(`     first view: ${bytes.reduce((a, b) => a + b, 0)} bytes before compression in ${bytes.length} files`);
  check("the 3D library is not loaded with the first view", !requested.some((one) => one.includes("viewer")));
  await page.getByRole("button", { name: "3D", exact: true }).last().click();
  await open(page);
  check("and is loaded with the 3D view", requested.some((one) => one.includes("viewer")));
  const { bodies } = await fetch(`${url}api/bodies/0`).then((answer) => answer.json());
  const drawnBodies = await page.locator("[data-test=scene]").evaluate((canvas) => Number(canvas.dataset.bodies));
  check(`the ${bodies.length} bodies of the machine are drawn`, bodies.length > 1 && drawnBodies === bodies.length);
  // What the program will do is shown before it is started.
  await select(url, "nas979_cone.nc");
  const programmed = () => page.locator("[data-test=scene]").evaluate((canvas) => Number(canvas.dataset.programmed ?? 0));
  await eventually("the programmed path is drawn", programmed, (count) => count > 100);
  const planned = await plannedSeconds(url);
  // That of the program before is shown until the new one is planned.
  await eventually(`the planned time is shown: ${planned} s`, () => shownSeconds(page), (shown) => shown === planned);
  check(`the planned time is shown: ${planned} s`, true);
  await look(page, "Fit");
  await shot(page, "scene-programmed");
  const before = await segments(page);
  const cone = await run(url, "nas979_cone.nc");
  await eventually("the executed path grows", () => segments(page), (count) => count > before + 30);
  check("the executed path grows", true);
  await ends(url, cone);
  for (const name of ["Front", "Right", "Top", "Space", "Whole"]) await look(page, name);
  await shot(page, "scene-whole");
  await look(page, "Fit");
  await shot(page, "scene-path");
  // Each message of the stream may be a picture, of which there are at most 20 a second; nothing else is.
  await drawn(page);
  const told = page.messages;
  const still = await frames(page);
  await streamed(page, 20);
  const [pictures, messages] = [(await frames(page)) - still, page.messages - told];
  check(`nothing is drawn while nothing moves: ${pictures} pictures for ${messages} messages`, pictures <= messages + 1);

  await page.evaluate(() => {
    Object.defineProperty(document, "hidden", { configurable: true, get: () => true });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await drawn(page);
  const hidden = await frames(page);
  await ends(url, await run(url, "rtcp.nc"));
  await streamed(page, 5);
  check("nothing is drawn while the tab is hidden", (await frames(page)) === hidden);
  await page.evaluate(() => {
    Object.defineProperty(document, "hidden", { configurable: true, get: () => false });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await eventually("it is drawn again when the tab is shown", async () => (await frames(page)) > hidden);
  await remainingTime(page, url);
  check(`the 3D view logs no errors ${page.complaints}`, page.complaints.length === 0);
  await page.context().close();
}

/** What is seen when the view is opened: at first everything, then what the operator has chosen. */
async function standpoints(browser, url) {
  await select(url, "nas979_cone.nc");
  const page = await openPage(browser, url);
  const picture = page.locator("[data-test=scene]");
  const standpoint = () => picture.evaluate((canvas) => (canvas.dataset.standpoint ?? "").split(",").map(Number));
  const same = (a, b) => a.length === b.length && a.every((one, i) => Math.abs(one - b[i]) < 1e-3);  // um, and pixels of a metre
  await open(page);
  await eventually("the programmed path is drawn", () => picture.evaluate((canvas) => Number(canvas.dataset.programmed ?? 0)), (count) => count > 100);
  await drawn(page);
  const first = await standpoint();
  await look(page, "Whole");
  check("the view opens with the whole machine and the path", same(await standpoint(), first));
  await picture.click();
  check("a click chooses nothing", !(await page.evaluate(() => localStorage.getItem("trunnion.scene"))));
  await look(page, "Front");
  const front = await standpoint();
  await picture.hover();
  await page.mouse.wheel(0, -300);
  await eventually("the wheel zooms", standpoint, (now) => !same(now, front));
  await drawn(page);
  const chosen = await standpoint();
  await page.getByRole("button", { name: "Operate", exact: true }).click();
  await page.waitForSelector(".positions");
  await open(page);
  await eventually("the view is as it was left", standpoint, (now) => same(now, chosen));
  await page.reload();
  await page.waitForSelector(".positions");
  await open(page);
  await eventually("the view is as it was left before the page was loaded again", standpoint, (now) => same(now, chosen));
  check(`the view is remembered: ${chosen}`, true);
  await page.context().close();
}

/** Passes the stream on, and puts messages with a long path into it. */
async function many(browser, url, rows) {
  const page = await openPage(browser, null);
  const point = (i) => [80 * Math.cos(i / 50) * (1 - i / rows / 2), 80 * Math.sin(i / 50) * (1 - i / rows / 2), -i / 2000, 0, 0];
  const part = Math.min(rows, 5000);
  const stream = await interceptStream(page);
  await page.goto(url);
  await page.waitForSelector(".positions");
  await open(page);
  // One part after the other: all at once would take the page longer than the silence that counts as a loss of the stream. What
  // such a loss costs is sent on top.
  for (let [sent, there] = [0, await segments(page)]; there < rows - 1; sent += part) {
    const points = Array.from({ length: part }, (_, i) => point((sent + i) % rows));
    const { send } = stream();
    pretend(stream, { trace: { first: 1 + sent, since: points.map((_, i) => i), axes: [0, 1, 2, 3, 4], rows: points } });
    const before = there;
    there = await eventually(`a part of the long path is there, beyond ${before} segments`, () => segments(page), (count) => count > before || stream().send !== send);
  }
  await look(page, "Space");
  const box = await page.locator("[data-test=scene]").boundingBox();
  const drawnSegments = () => page.locator("[data-test=scene]").evaluate((canvas) => canvas.dataset.drawn);
  const fully = await drawnSegments();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  const [before, start] = [await frames(page), Date.now()];
  let moves = 0;
  await eventually("30 pictures are drawn while it is turned", async () => {
    for (const end = moves + 60; moves < end; ++moves) await page.mouse.move(box.x + box.width / 2 + 200 * Math.sin(moves / 20), box.y + box.height / 2 + 60 * Math.cos(moves / 20));
    return (await frames(page)) - before;
  }, (pictures) => pictures >= 30);
  const [after, end] = [await frames(page), Date.now()];
  const coarsely = await drawnSegments();
  await page.mouse.up();
  const renderer = await page.evaluate(() => document.createElement("canvas").getContext("webgl2")?.getParameter(0x1f01) ?? "");
  console.log(`     ${await segments(page)} segments: ${((1000 * (after - before)) / (end - start)).toFixed(1)} frames/s while turning (${coarsely} drawn, ${fully} at rest; ${renderer})`);
  check(`a path of ${rows - 1} segments is drawn while it is turned`, after > before);
  if (rows > 1000) await shot(page, "scene-long-path");
  await page.context().close();
}

export async function scene(browser, url) {
  await standpoints(browser, url);
  await growing(browser, url);
  for (const rows of [101, 200_001]) await many(browser, url, rows);
}
