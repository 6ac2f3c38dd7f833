// SPDX-License-Identifier: Apache-2.0
// Setup on a real cluster: work offsets from the present position and by deltas, tools, tilted planes, and the undo.
import { appears, channelState, check, eventually, hand, knows, mdi, openPage, overflowing, post, shot, told } from "./harness.mjs";

const offsets = (url) => fetch(`${url}api/work-offsets`).then((answer) => answer.json());
const offset = async (url, index) => (await offsets(url)).offsets.find((one) => one.channel === 0 && one.index === index)?.values ?? Array(9).fill(0);
const tool = async (url, number) => (await (await fetch(`${url}api/tools`)).json()).tools.find((one) => one.number === number);
const putOffset = (url, index, values) => fetch(`${url}api/work-offsets`, { method: "PUT", body: JSON.stringify({ channel: 0, index, values }) });
// A simulated axis is at its position to 0.1 um.
const near = (a, b) => Math.abs(a - b) < 1e-4;

async function workOffsets(page, url) {
  await putOffset(url, 1, Array(9).fill(0));
  await putOffset(url, 8, Array(9).fill(0));
  await mdi(url, "G54 G90 G69 G0 X10 Y-4", { workpiece: { X: 10, Y: -4 } });
  await knows(page, "X is at 10", ({ workpiece: [x] }) => near(x, 10));
  await page.getByRole("tab", { name: "Work offsets" }).click();
  await page.getByRole("button", { name: "G55", exact: true }).click();
  const form = page.getByRole("region", { name: "Set G55" }).first();
  await form.getByRole("textbox", { name: "X shall show" }).pressSequentially("2.5", hand);
  await form.getByRole("button", { name: "set X of G55" }).click();
  // G54 X is 0 and the axis is at 10: G55 is 7.5 where X is to show 2.5.
  await eventually("the offset is stored", async () => near((await offset(url, 1))[0], 7.5));
  await mdi(url, "G55");
  await eventually("the position shows what was wanted", async () => near((await channelState(url)).workpiece[0], 2.5));
  check("an offset is set from the present position", true);
  await mdi(url, "G54");
  const undo = page.getByRole("button", { name: /^Undo: G55 X 0.000 → 7.500/ });
  await undo.click();
  await eventually("it is taken back", async () => near((await offset(url, 1))[0], 0));
  check("the last change is taken back", true);

  await page.getByRole("button", { name: "G54", exact: true }).click();
  const active = page.getByRole("region", { name: "Set G54" }).first();
  const before = (await offset(url, 0))[0];
  for (const place of ["2.5", "4"]) {
    await active.getByRole("textbox", { name: "X shall show" }).fill(place);
    await active.getByRole("button", { name: "set X of G54" }).click();
  }
  await eventually("the second one is of the position with the first", async () => near((await offset(url, 0))[0], before + 6));
  await eventually("the position shows it", async () => near((await channelState(url)).workpiece[0], 4));
  check("the active offset is set twice, each time from the position of then", true);
  for (const change of [/^Undo: G54 X 7.500 → 6.000/, /^Undo: G54 X 0.000 → 7.500/]) await page.getByRole("button", { name: change }).click();
  await eventually("both are taken back", async () => near((await offset(url, 0))[0], before));
  await page.getByRole("button", { name: "G55", exact: true }).click();

  await form.getByRole("textbox", { name: "add to X" }).pressSequentially("0,1", hand);
  await form.getByRole("textbox", { name: "add to Y" }).pressSequentially("-0.25", hand);
  await form.getByRole("button", { name: "Add to G55" }).click();
  await eventually("both are added", async () => {
    const values = await offset(url, 1);
    return near(values[0], 0.1) && near(values[1], -0.25);
  });
  check("deltas of several axes are added at once", true);
  await page.getByRole("button", { name: /^Undo: G55/ }).waitFor();
  await putOffset(url, 1, [1, 2, 3, 0, 0, 0, 0, 0, 0]);
  await told(page, /changed (again )?meanwhile/, () => page.getByRole("button", { name: /^Undo: G55/ }).click(), { refused: true });
  check("what another station has changed since is not taken back", near((await offset(url, 1))[0], 1));

  const cell = page.getByLabel("G54.1 P3 Y");
  await cell.scrollIntoViewIfNeeded();
  await cell.click();
  await page.keyboard.type("-55.25", hand);
  await page.keyboard.press("Enter");
  await eventually("G54.1 P3 is stored", async () => near((await offset(url, 8))[1], -55.25));
  check("G54.1 offsets are typed as the others", true);
  await page.getByRole("button", { name: /^Undo: G54.1 P3/ }).click();
  await eventually("and taken back", async () => near((await offset(url, 8))[1], 0));

  await mdi(url, "G68 X0 Y0 R10");
  await form.getByText(/Not with G68/).waitFor();
  check("in turned coordinates the keys are dark and say why", await form.getByRole("button", { name: "set X of G55" }).isDisabled());
  await mdi(url, "G69");
  await eventually("they are usable again", () => form.getByRole("button", { name: "set X of G55" }).isEnabled());
  await page.locator(".list .scroll").evaluate((element) => (element.scrollTop = 0));
  await page.locator(".notice").waitFor({ state: "detached" });
  await shot(page, "setup-offsets");
  const cut = await overflowing(page);
  check(`the work offsets fit ${cut}`, cut.length === 0);
  await putOffset(url, 1, Array(9).fill(0));
}

async function tools(page, url) {
  await fetch(`${url}api/tools/77`, { method: "DELETE" });
  await page.getByRole("tab", { name: "Tools" }).click();
  await page.getByRole("textbox", { name: "Tool number" }).pressSequentially("77", hand);
  await page.getByRole("button", { name: "New tool" }).click();
  const length = page.getByLabel("T77 Length", { exact: true });
  await length.click();
  await page.keyboard.type("80.5", hand);
  await page.keyboard.press("Enter");
  await eventually("the length is stored", async () => (await tool(url, 77))?.length === 80.5);
  const name = page.getByLabel("Name of T77");
  await name.click();
  await page.keyboard.type("Drill 8", hand);
  await page.keyboard.press("Enter");
  await eventually("the name is stored", async () => (await tool(url, 77))?.name === "Drill 8");
  check("a tool is entered", (await tool(url, 77)).length === 80.5);
  const row = page.locator("tr", { has: page.locator("[data-test=life-77]") });
  for (const [label, typed, field, stored, shown] of [
    ["T77 Type", "drill", "type", "drill", "drill"],
    ["T77 Life used", "12.5", "life_used", 12.5, "12.5 min"],
    ["T77 Life limit", "12", "life_limit", 12, "12.5 / 12 min"],
  ]) {
    await page.getByLabel(label, { exact: true }).click();
    await page.getByLabel(label, { exact: true }).fill(typed);
    await page.keyboard.press("Enter");
    await eventually(`${label} is stored`, async () => (await tool(url, 77))?.[field] === stored);
    // The next change is one of the table that the page has: it must know this one.
    await eventually(`${label} is shown`, () => row.innerText(), (text) => text.includes(shown));
  }
  await page.getByRole("combobox", { name: "Unit of life" }).selectOption("PIECES");
  await eventually("the life is shown with its limit and unit", () => page.locator("[data-test=life-77]").innerText(), (shown) => shown === "12.5 / 12 pieces");
  check("a tool has type and life, and one that is used up is marked", (await page.locator("[data-test=life-77] .warn").count()) === 1);
  await page.getByRole("textbox", { name: "add to Length wear" }).pressSequentially("-0.02", hand);
  await page.keyboard.press("Enter");
  await eventually("the wear is added", async () => (await tool(url, 77))?.length_wear === -0.02);
  await page.getByText("80.480 mm").waitFor();
  check("wear is added to, and the sum is shown", true);
  const radius = page.getByLabel("T77 Radius", { exact: true });
  await radius.click();
  await page.keyboard.type("-3", hand);
  const limits = await told(page, "radius", () => page.keyboard.press("Enter"), { refused: true });
  check("a value beyond its limits is refused with them", /0 \.\./.test(limits));
  await shot(page, "setup-tools");
  await page.getByRole("button", { name: "Delete T77" }).click();
  await page.getByRole("alertdialog", { name: /Delete tool T77/ }).getByRole("button", { name: "Delete" }).click();
  await eventually("it is gone", async () => (await tool(url, 77)) === undefined);
  await page.getByRole("button", { name: "Undo: T77 deleted" }).click();
  await eventually("it is back", async () => (await tool(url, 77))?.name === "Drill 8");
  check("a deleted tool comes back with all its fields", (await tool(url, 77)).length_wear === -0.02);
  await fetch(`${url}api/tools/77`, { method: "DELETE" });
}

/** At an override of 0 a line does not come to its end: the channel is not at rest for as long as the test wants. */
async function intoSpindle(page, url) {
  const load = page.getByRole("button", { name: "Load T2 into spindle" });
  const place = () => page.locator("[data-test=place-2]").innerText();
  await eventually("the place of T2 is that of the PLC's table", place, (shown) => /^\d+$/.test(shown));
  await page.getByRole("button", { name: "Tool T2", exact: true }).click();
  await post(url, "channels/0/override", { kind: "feed", value: 0 });
  await eventually("a line is under way", async () => (await post(url, "channels/0/mdi", { line: "G91 G1 X1 F100" })).ok);
  await knows(page, "the channel runs", ({ state }) => state === "RUNNING");
  await told(page, /^Load T2 into spindle: the channel is not at rest \(RUNNING\)/, () => load.click(), { refused: true });
  check("a tool is not loaded while the channel moves, and it is said why", (await channelState(url)).state === "RUNNING");
  await post(url, "channels/0/reset");
  await post(url, "channels/0/override", { kind: "feed", value: 1 });
  await knows(page, "the channel is at rest", ({ state }) => state === "IDLE");
  await post(url, "channels/0/mode", { mode: "JOG" });
  await knows(page, "the channel is at rest in another mode", ({ state, mode }) => state === "IDLE" && mode === "JOG");
  await told(page, "T2 M6 is being executed", () => load.click(), { refused: false });
  await eventually("the tool is changed", () => channelState(url), ({ state, tool }) => state === "IDLE" && tool === 2);
  await eventually("it needs no second change", () => load.isDisabled());
  await eventually("and the PLC has it there", place, (shown) => shown === "spindle");
  check("a tool of the table is loaded into the spindle by its key", (await channelState(url)).mode === "MDI");
}

async function planes(page, url) {
  await page.getByRole("tab", { name: "Tilted planes" }).click();
  await page.getByRole("button", { name: /G68.1 Q3/ }).click();
  const teach = (point) => page.getByRole("button", { name: `${point}: take the position of the tool tip` });
  for (const [line, [X, Y, Z], point] of [
    ["G54 G0 X0 Y0 Z300", [0, 0, 300], "Origin"], ["G0 X20", [20, 0, 300], "Point on +X"], ["G0 X0 Y20 Z310", [0, 20, 310], "Point towards +Y"],
  ]) {
    await mdi(url, line, { workpiece: { X, Y, Z } });
    await knows(page, `the tool tip is at ${[X, Y, Z]}`, (one) => one.state === "IDLE" && [X, Y, Z].every((value, i) => Math.abs(one.workpiece[i] - value) < 1e-3));
    await teach(point).focus();
    await told(page, `Q3 ${point} is stored`, () => page.keyboard.press("Enter"));
  }
  // X (20 0 0) times Y (0 20 10) is (0 -200 400), as a unit vector (0 -0.4472 0.8944).
  await eventually("the plane has its normal", async () => (await page.locator("[data-test=plane-normal]").innerText()).replace(/\u2212/g, "-") === "0.0000 -0.4472 0.8944");
  check("a plane is taught by three positions, with the keyboard alone", true);
  check("and said to wait for the reset", await appears(page.getByText(/takes effect at the next reset/)));
  await shot(page, "setup-planes");
  const cut = await overflowing(page);
  check(`the planes fit ${cut}`, cut.length === 0);
  await page.getByRole("button", { name: "Clear plane 3" }).click();
  await eventually("it is empty", async () => (await page.locator("[data-test=plane-normal]").innerText()) === "–");
  await page.getByRole("button", { name: /^Undo: plane 3 cleared/ }).click();
  await eventually("and back", async () => (await page.locator("[data-test=plane-normal]").innerText()) !== "–");
  check("nine values are taken back at once", true);
  await page.getByRole("button", { name: "Clear plane 3" }).click();
  await eventually("it is empty", async () => (await page.locator("[data-test=plane-normal]").innerText()) === "–");
  await post(url, "channels/0/reset");
}

export async function setup(browser, url) {
  await post(url, "channels/0/mode", { mode: "MDI" });
  const page = await openPage(browser, url);
  await page.getByRole("navigation", { name: "Views" }).getByRole("button", { name: "Setup", exact: true }).click();
  await workOffsets(page, url);
  await tools(page, url);
  await intoSpindle(page, url);
  await planes(page, url);
  check(`setup logs no errors ${page.complaints}`, page.complaints.length === 0);
  await page.context().close();
}
