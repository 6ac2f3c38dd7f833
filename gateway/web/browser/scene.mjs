// SPDX-License-Identifier: Apache-2.0
// The 3D view: loaded when it is opened, grows with the executed path, draws nothing for a hidden tab. Its frame rate with
// 200,000 segments is printed, not judged: it depends on the computer, and here no graphics card draws.
import { channelState, check, eventually, openPage, post, shot } from "./harness.mjs";

const frames = (page) => page.locator("[data-test=scene]").evaluate((canvas) => Number(canvas.dataset.frames ?? 0));
const segments = (page) => page.locator("[data-test=scene]").evaluate((canvas) => Number(canvas.dataset.segments ?? 0));
const open = async (page) => {
  await page.getByRole("button", { name: "3D", exact: true }).first().click();
  await page.locator("[data-test=segments]").waitFor();
};

async function run(url, program) {
  await post(url, "channels/0/mode", { mode: "AUTO" });
  await post(url, "channels/0/select", { program });
  await eventually("the program is selected", async () => (await channelState(url)).program === program);
  await eventually("the program starts", async () => (await post(url, "channels/0/cycle-start")).ok);
}

async function growing(browser, url) {
  const page = await openPage(browser, null);
  const requested = [];
  page.on("request", (request) => requested.push(request.url()));
  await page.goto(url);
  await page.waitForSelector(".positions");
  await page.waitForTimeout(500);
  const bytes = (await Promise.all(requested.filter((one) => /\.(js|css|html)$|\/$/.test(one)).map((one) => fetch(one).then((r) => r.arrayBuffer())))).map((b) => b.byteLength);
  console.log(`     first view: ${bytes.reduce((a, b) => a + b, 0)} bytes before compression in ${bytes.length} files`);
  check("the 3D library is not loaded with the first view", !requested.some((one) => one.includes("viewer")));
  await page.getByRole("button", { name: "3D", exact: true }).last().click();
  await open(page);
  check("and is loaded with the 3D view", requested.some((one) => one.includes("viewer")));
  const before = await segments(page);
  await run(url, "nas979_cone.nc");
  await eventually("the executed path grows", async () => (await segments(page)) > before + 100, 30);
  check("the executed path grows", true);
  await eventually("the program ends", async () => (await channelState(url)).state === "IDLE", 60);
  await page.waitForTimeout(300);
  for (const name of ["Front", "Right", "Top", "Space"]) {
    const drawn = await frames(page);
    await page.getByRole("button", { name, exact: true }).click();
    await eventually(`the view ${name} is drawn`, async () => (await frames(page)) > drawn);
  }
  await page.getByRole("button", { name: "Fit" }).click();
  await page.waitForTimeout(400);
  await shot(page, "scene-path");
  const still = await frames(page);
  await page.waitForTimeout(1500);
  check("nothing is drawn while nothing moves", (await frames(page)) - still <= 35);

  await page.evaluate(() => {
    Object.defineProperty(document, "hidden", { configurable: true, get: () => true });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await page.waitForTimeout(200);
  const hidden = await frames(page);
  await run(url, "rtcp.nc");
  await eventually("the program ends", async () => (await channelState(url)).state === "IDLE", 60);
  check("nothing is drawn while the tab is hidden", (await frames(page)) === hidden);
  await page.evaluate(() => {
    Object.defineProperty(document, "hidden", { configurable: true, get: () => false });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await eventually("it is drawn again when the tab is shown", async () => (await frames(page)) > hidden);
  check(`the 3D view logs no errors ${page.complaints}`, page.complaints.length === 0);
  await page.context().close();
}

/** Passes the stream on, and puts a long path into one of its messages. */
async function many(browser, url, rows) {
  const page = await openPage(browser, null);
  let sent = false;
  await page.routeWebSocket(/api\/stream/, (socket) => {
    const server = socket.connectToServer();
    socket.onMessage((message) => server.send(message));
    server.onMessage((text) => {
      const message = JSON.parse(text);
      if (sent || !("changes" in message)) return socket.send(text);
      sent = true;
      const points = Array.from({ length: rows }, (_, i) => [80 * Math.cos(i / 50) * (1 - i / rows / 2), 80 * Math.sin(i / 50) * (1 - i / rows / 2), -i / 2000, 0, 0]);
      message.changes.trace = { first: 1, since: points.map((_, i) => i), axes: [0, 1, 2, 3, 4], rows: points };
      socket.send(JSON.stringify(message));
    });
  });
  await page.goto(url);
  await page.waitForSelector(".positions");
  await open(page);
  await eventually("the long path is there", async () => (await segments(page)) >= rows - 1, 30);
  await page.getByRole("button", { name: "Space", exact: true }).click();
  await page.waitForTimeout(500);
  const box = await page.locator("[data-test=scene]").boundingBox();
  const drawnSegments = () => page.locator("[data-test=scene]").evaluate((canvas) => canvas.dataset.drawn);
  const fully = await drawnSegments();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  const [before, start] = [await frames(page), Date.now()];
  for (let i = 0; Date.now() - start < 3000; ++i) await page.mouse.move(box.x + box.width / 2 + 200 * Math.sin(i / 20), box.y + box.height / 2 + 60 * Math.cos(i / 20));
  const [after, end] = [await frames(page), Date.now()];
  const coarsely = await drawnSegments();
  await page.mouse.up();
  const drawn = await page.evaluate(() => document.createElement("canvas").getContext("webgl2")?.getParameter(0x1f01) ?? "");
  console.log(`     ${await segments(page)} segments: ${((1000 * (after - before)) / (end - start)).toFixed(1)} frames/s while turning (${coarsely} drawn, ${fully} at rest; ${drawn})`);
  check(`a path of ${rows - 1} segments is drawn while it is turned`, after > before);
  if (rows > 1000) await shot(page, "scene-long-path");
  await page.context().close();
}

export async function scene(browser, url) {
  await growing(browser, url);
  for (const rows of [101, 200_001]) await many(browser, url, rows);
}
