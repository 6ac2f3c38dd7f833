// SPDX-License-Identifier: Apache-2.0
// The measurement of the kinematics from the page to the written vectors and their undo, on a real cluster whose table is
// displaced (examples/calibration/truth.yaml).
import { readFileSync } from "node:fs";
import {
  check, coveredStops, eventually, hand, inaccessible, openPage, overflowing, post, runTest, settled, shot, smallTargets, told,
} from "./harness.mjs";

const read = (url, path) => fetch(`${url}api/${path}`).then((answer) => answer.json());
const parameter = (url, number) => read(url, `parameters/${number}`);
const state = async (url) => (await read(url, "measurement")).state;
/** Each pose has its time. */
async function inPhase(url, wanted) {
  for (let last = await state(url); last.phase !== wanted;) {
    const { complete } = last;
    last = await eventually(`the phase is ${wanted}, or a further pose is complete`, () => state(url), (now) => now.phase === wanted || now.complete > complete);
  }
}

const openView = async (page, setup = "Setup", kinematics = "Kinematics") => {
  await page.locator('[data-test="view-setup"]').click();
  await page.getByRole("tab", { name: kinematics, exact: true }).click();
  await page.locator(".measurement-form").waitFor();
};

const field = (page, name) => page.getByRole("textbox", { name, exact: true });

async function type(page, name, value) {
  const box = field(page, name);
  await box.click();
  await page.keyboard.press("ControlOrMeta+a");
  await box.pressSequentially(value, hand);
}

async function looksRight(page, name) {
  await page.locator(".notice").waitFor({ state: "detached" });
  await settled(page);
  await shot(page, name);
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)],
    ["stops are free", await coveredStops(page)], ["axe-core", await inaccessible(page)]])
    check(`${name}: ${what} ${found}`, found.length === 0);
}

async function inputs(page, url) {
  await openView(page);
  await field(page, "Probe length").waitFor();
  check("the fields have the machine's probe, sphere and ranges", (await field(page, "Probe length").inputValue()) === "60" &&
    (await field(page, "Centre of the sphere Z").inputValue()) === "-360" && (await field(page, "C Points").inputValue()) === "8");
  const start = page.getByRole("button", { name: "Start measurement" });
  await type(page, "A Points", "2");
  await page.getByText("Not within 3 … 12.").waitFor();
  check("beyond a limit Start is dark, and the limit is said", await start.isDisabled());
  await type(page, "A Points", "3");
  await type(page, "A Start", "-60");
  const [low, high] = (await read(url, "measurement/inputs")).travel.A;
  await type(page, "A End", String(high + 1));
  await page.getByText(`Not within ${low} … ${high}.`).waitFor();
  await type(page, "A End", "-60");
  await page.getByText("The end must be above the start.").waitFor();
  await type(page, "A End", "60");
  check("typed values stand as they were typed", (await field(page, "A Start").inputValue()) === "-60" && (await start.isEnabled()));
  await type(page, "C Points", "3");
  await type(page, "C End", "240");
  await page.getByRole("combobox", { name: "Mode" }).selectOption("correct");
  await page.getByRole("button", { name: "YAML", exact: true }).click();
  const text = page.getByRole("textbox", { name: "Inputs" });
  const yaml = await text.inputValue();
  check("the YAML has what was typed", /mode: correct\n/.test(yaml) && /  A:\n    start_deg: -60\n    end_deg: 60\n    points: 3\n/.test(yaml));
  await text.fill(yaml.replace("  touches: 10", "  touches: 9"));
  await start.click();
  await page.getByText(/^Refused: Line \d+: .*9/).waitFor();
  const marked = await text.evaluate((area) => area.value.slice(area.selectionStart, area.selectionEnd));
  check(`the refusal of the service is shown, with its line marked: ${marked}`, marked.includes("touches: 9"));
  check("and nothing has begun", (await state(url)).phase === "NOTHING");
  await shot(page, "kinematics-refused");
  await page.getByRole("button", { name: "From the fields" }).click();
  check("the text comes back from the fields", (await text.inputValue()) === yaml);
  await page.getByRole("button", { name: "Fields", exact: true }).click();
  await looksRight(page, "kinematics-inputs");
  await page.getByRole("combobox", { name: "Mode" }).selectOption("only_correct");
  await start.click();
  await page.getByText(/^Refused: .*0 of 5 poses are kept; measure first/).waitFor();
  check("a refusal of the fields is shown with them", (await state(url)).phase === "NOTHING");
  await page.getByRole("combobox", { name: "Mode" }).selectOption("correct");
  // Ways at ten times the delivered feed: the 420 degrees would last 70 s. What has no field: a change beyond 0.05 mm must be acknowledged.
  await page.getByRole("button", { name: "YAML", exact: true }).click();
  await page.getByRole("button", { name: "From the fields" }).click();
  await text.fill((await text.inputValue()).replace("rotary_feed_deg_per_min: 360\n", "rotary_feed_deg_per_min: 3600\n"));
  await text.press("ControlOrMeta+Home");
  await text.pressSequentially("vector_tolerance_mm: 0.05\n", hand);
}

async function aborted(page, url) {
  const start = page.getByRole("button", { name: "Start measurement" });
  await start.focus();
  await page.keyboard.press("Enter");
  await inPhase(url, "MEASURING");
  await page.getByText(/^Pose \d of 5/).waitFor();
  check("the pose is said, and the progress is a progress bar", (await page.getByRole("progressbar", { name: "Progress of the measurement" }).getAttribute("aria-valuetext")).includes("of 5"));
  check("no other is started meanwhile", await start.isDisabled());
  await eventually("a pose is complete", async () => (await state(url)).complete >= 1);
  await page.getByRole("button", { name: "Abort", exact: true }).dispatchEvent("pointerdown", { button: 0 });
  await inPhase(url, "INTERRUPTED");
  await page.locator(".measurement .refusal").filter({ hasText: /aborted.*nothing written, \d of 5 poses are complete/ }).waitFor();
  check("an abort acts on the press and says what is kept", true);
  check("a complete pose is named", /^A0 C0\s/.test(await page.getByRole("table", { name: "Poses" }).locator("tbody tr").first().innerText()));
  await start.click();
  await page.getByRole("alertdialog").filter({ hasText: "Give up the poses" }).getByRole("button", { name: "Cancel" }).click();
  check("a new start asks before it gives up what is kept", (await state(url)).phase === "INTERRUPTED");
  await shot(page, "kinematics-interrupted");
  const kept = (await state(url)).complete;
  // As by hand: reset, alarms, off the sphere.
  await eventually("the machine is free again", async () => {
    await post(url, "channels/0/reset");
    await post(url, "alarms/reset");
    await post(url, "channels/0/mode", { mode: "MDI" });
    if (!(await post(url, "channels/0/mdi", { line: "G53 G1 Z0 F3000" })).ok) return false;
    // The state may be one of before the block: Z says that it has run.
    await eventually("Z is up", async () => {
      const channel = await read(url, "channels/0");
      return channel.state === "IDLE" && channel.positions.some(({ letter, machine }) => letter === "Z" && Math.abs(machine) < 1e-3);
    });
    return (await state(url)).may_continue;
  });
  const go = page.getByRole("button", { name: "Continue", exact: true });
  await eventually("it may be continued", () => go.isEnabled());
  await go.click();
  await eventually(async () => `it goes on: ${await page.locator(".measurement .refusal").allInnerTexts()}`, async () => (await state(url)).phase !== "INTERRUPTED");
  await inPhase(url, "WAITING");
  check("it continues after the complete poses", kept >= 1 && (await state(url)).complete === 5);
}

async function written(page, url) {
  const before = (await parameter(url, 40433)).value;
  const confirm = page.getByRole("button", { name: "Write result" });
  await page.getByRole("table", { name: "Vectors" }).waitFor();
  // The vector of A in Y: 120 um of the truth and 90 um that C is off (examples/calibration/truth.yaml); inclinations of
  // 36 urad over some 82 mm go into the offsets.
  const row = (await page.getByRole("table", { name: "Vectors" }).getByRole("row").allInnerTexts()).map((text) => text.split(/\s+/));
  const changed = Number(row.find(([axis, component]) => axis === "A" && component === "Y")?.[4].replace("\u2212", "-"));
  check(`the table of the vectors has the displacement of A: ${changed} um`, Math.abs(changed - 210) < 5);
  check("every pose has a row", (await page.getByRole("table", { name: "Poses" }).locator("tbody tr").count()) === 5);
  const plot = page.getByRole("img", { name: /^Residual after of 5 poses in X, Y and Z, um; the largest is/ });
  check("the plot has a mark for each axis of each pose", (await plot.locator("circle").count()) === 5 && (await plot.locator("path").count()) === 5);
  await page.getByRole("button", { name: "Difference before" }).click();
  await page.getByRole("img", { name: /^Difference before of 5 poses/ }).waitFor();
  await page.getByRole("button", { name: "Residual after" }).click();
  await page.getByRole("table", { name: "Parameters that change" }).getByText("040433").waitFor();
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Download protocol" }).click()]);
  const protocol = readFileSync(await file.path(), "utf8");
  check("the protocol is the file", protocol === (await read(url, "measurement")).result.protocol && protocol.length > 500);
  await page.locator(".measurement-report > .scroll").evaluate((element) => (element.scrollTop = 0));
  await looksRight(page, "kinematics-result");
  await page.locator(".measurement .refusal").filter({ hasText: "0.05" }).waitFor();
  await confirm.click();
  const question = page.getByRole("alertdialog");
  check(`beyond the tolerance it asks once: ${await question.innerText()}`, /Write the parameters in spite of it\?/.test(await question.innerText()));
  check("the question does not cover the stops", (await coveredStops(page)).length === 0);
  await shot(page, "kinematics-question");
  await question.getByRole("button", { name: "Write in spite of it" }).click();
  await inPhase(url, "FINISHED");
  await page.getByText("Parameters are written; active after a reset of the channel.").waitFor();
  await post(url, "channels/0/reset");
  await eventually("the vector is written", async () => Math.abs((await parameter(url, 40433)).value - before - 0.21) < 0.005);
  check("the vectors are written", true);
  const undo = page.getByRole("button", { name: "Undo calibration" });
  await eventually("it can be undone", () => undo.isEnabled());
  check("who and when is said", /calibrate.*parameters/.test(await undo.getAttribute("title")));
  await undo.click();
  await told(page, "have the values of before", () => page.getByRole("alertdialog").getByRole("button", { name: "Undo calibration" }).click());
  await post(url, "channels/0/reset");
  await eventually("the vector is that of before", async () => (await parameter(url, 40433)).value === before);
  check("the undo gives the values of before", true);
  await eventually("nothing is undone twice", () => undo.isDisabled());
  check("and says so", /undone already/.test(await undo.getAttribute("title")));
  const twice = await post(url, "measurement/undo");
  const problem = await twice.json();
  check(`over HTTP too: ${problem.detail}`, twice.status === 409 && /undone already/.test(problem.detail));
  await page.getByRole("button", { name: "Discard", exact: true }).click();
  await page.getByRole("alertdialog").getByRole("button", { name: "Discard" }).click();
  await inPhase(url, "NOTHING");
  await page.getByText("No pose is complete yet.").waitFor();
  check("poses and result are discarded", true);
}

/** With dial and edge finder: typed as an operator types, over a reload; written, and undone. */
async function byDial(page, url) {
  const guide = await read(url, "measurement/manual");
  const [[cx, cy, cz], before] = [guide.vectors.find(({ axis }) => axis === "C").offset_mm, (await parameter(url, 40435)).value];
  await page.getByRole("tab", { name: "By dial" }).click();
  const field = (name) => page.locator(`[data-test="manual-${name}"]`);
  const compute = page.locator('[data-test="manual-compute"]');
  check("without readings nothing is computed", await compute.isDisabled());
  // The bore says that C is 0.1 mm beside its vector in X. A90 swings by 0.4: A is 0.2 in Y. The two touches are 20 mm apart
  // with a tool of 5 mm radius: -20 - 0.2 + 5 = -15.2; the tool is 300 long; so C stays where it is in Z.
  const readings = {
    x1: cx + 0.1 - 50, x2: cx + 0.1 + 50, y1: cy - 49.8, y2: cy + 49.8, offy_z1: 0.4, zc_z1: cz + 315.2, zc_y1: -20, zc_z2: -300, tool_radius: 5,
  };
  await field("x1").pressSequentially(readings.x1.toFixed(6).replace(".", ","), hand);
  for (const [name, value] of Object.entries(readings).slice(1)) await field(name).fill(value.toFixed(6));
  await page.locator(".manual-checks input").first().check();
  await page.reload();
  await page.locator('[data-test="view-setup"]').click();
  await page.getByRole("tab", { name: "By dial" }).click();
  await field("x2").waitFor();
  check("a reload keeps what was typed", (await field("x2").inputValue()) === readings.x2.toFixed(6) && (await page.locator(".manual-checks input").first().isChecked()));
  await compute.click();
  const rows = page.locator('[data-test="manual-result-readings"]').getByRole("table", { name: "Vectors" }).getByRole("row");
  await rows.first().waitFor();
  const changes = (await rows.allInnerTexts()).map((text) => text.split(/\s+/));
  const change = (axis, component) => changes.find((row) => row[0] === axis && row[1] === component)?.[4];
  check(`the vectors follow: ${change("C", "X")}, ${change("C", "Z")}`, change("C", "X") === "+100.0" && change("C", "Z") === "0.0");
  await looksRight(page, "manual-calibration");
  await page.locator('[data-test="manual-write-readings"]').click();
  await told(page, "parameters are written; active after a reset", () => page.getByRole("alertdialog").getByRole("button", { name: "Write result" }).click());
  await page.locator(".manual").getByText(/waits for a reset: reset the channel first/).waitFor();
  await post(url, "channels/0/reset");
  await eventually("the vector is written", async () => Math.abs((await parameter(url, 40435)).value - before - 0.1) < 1e-3);
  check("the vectors of the dial are written", true);

  await page.locator('[data-test="manual-pose-0-X"]').waitFor();
  for (let i = 0; i < 9; ++i) for (const letter of "XYZ") await page.locator(`[data-test="manual-pose-${i}-${letter}"]`).fill("0.001");
  const evaluate = page.locator('[data-test="manual-evaluate"]');
  await evaluate.click();
  await page.getByText("All are within their limits: nothing is to be corrected.").waitFor();
  await page.locator('[data-test="manual-pose-2-X"]').fill("0,101");
  check("what was typed since is not evaluated", (await page.locator('[data-test="manual-acceptance"]').count()) === 0);
  await evaluate.click();
  const exceeded = page.locator('[data-test="manual-acceptance"] .refusal');
  await exceeded.first().waitFor();
  check("the limit that is exceeded is named", (await exceeded.count()) === 1);
  await page.locator('[data-test="manual-write-displacements"]').click();
  await page.getByRole("alertdialog").getByRole("button", { name: "Write result" }).click();
  await page.locator(".manual").getByText(/waits for a reset: reset the channel first/).waitFor();
  await post(url, "channels/0/reset");
  await page.locator('[data-test="manual-pose-2-X"]').waitFor();
  // X of C: half of the 0.1 mm between C0 and C180.
  await eventually("the correction is written", async () => Math.abs((await parameter(url, 40435)).value - before - 0.15) < 1e-3);
  check("what has corrected once cannot correct again", (await page.locator('[data-test="manual-pose-2-X"]').inputValue()) === "" && (await evaluate.isDisabled()));
  check("the undo takes the correction back", (await post(url, "measurement/undo")).ok);
  await post(url, "channels/0/reset");
  await eventually("the correction is undone", async () => Math.abs((await parameter(url, 40435)).value - before - 0.1) < 1e-3);
}

/** The same in other sizes, languages and colours. */
async function appearance(browser, url) {
  for (const [size, locale, colorScheme, tab] of [[[1920, 1080], "de-DE", "light", "Kinematik"], [[1280, 800], "zh-CN", "dark", "运动学"], [[390, 844], "de-DE", "dark", "Kinematik"]]) {
    const page = await openPage(browser, url, { size, locale, colorScheme });
    await page.locator('[data-test="view-setup"]').click();
    await page.getByRole("tab", { name: tab, exact: true }).click();
    await page.locator(".residual-plot").waitFor();
    await settled(page);
    const name = `kinematics-${size[0]}-${locale}`;
    await shot(page, name);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
    check(`${name}: the page is not wider than the screen`, !wide);
    for (const [what, found] of [["stops are free", await coveredStops(page)], ["touch targets", await smallTargets(page)], ["axe-core", await inaccessible(page)]])
      check(`${name}: ${what} ${found}`, found.length === 0);
    if (size[0] === 390) {
      await page.locator(".measurement-report").scrollIntoViewIfNeeded();
      await shot(page, `${name}-result`);
    }
    await page.context().close();
  }
}

await runTest(async (browser, url) => {
  await post(url, "channels/0/mode", { mode: "MDI" });
  const page = await openPage(browser, url);
  await inputs(page, url);
  await aborted(page, url);
  await appearance(browser, url);
  await written(page, url);
  await byDial(page, url);
  check(`the view logs no errors ${page.complaints}`, page.complaints.length === 0);
});
