// SPDX-License-Identifier: Apache-2.0
// The programs of the PLC on a real cluster: source with live values, search, force and release, trace, task times, new
// programs; in English, Chinese and German.
import { appears, check, eventually, hand, inaccessible, openPage, overflowing, post, shot, smallTargets, told } from "./harness.mjs";

const forces = (url) => fetch(`${url}api/plc/forces`).then(async (answer) => (await answer.json()).values.map(({ path }) => path));

async function open(page, view, programs) {
  await page.getByRole("navigation").getByRole("button", { name: view, exact: true }).click();
  await page.getByRole("button", { name: programs, exact: true }).click();
}

async function english(browser, url) {
  const page = await openPage(browser, url);
  await open(page, "Diagnosis", "PLC programs");
  const source = page.getByRole("region", { name: "main.st" });
  await source.getByText("PROGRAM main").waitFor();
  check("the source that runs is shown", true);
  await page.locator('[data-path^="main."]').first().waitFor();
  const beside = source.locator(".plc-line").filter({ hasText: "code := SEL(m_strobe_0" });
  await beside.scrollIntoViewIfNeeded();
  await beside.getByText(/code = 65535/).waitFor();
  // The newest M code: none yet, or the M6 of the tool table's key.
  await beside.getByText(/m_code_0 = (0|6)\b/).waitFor();
  check("with the live values of a line beside it", true);
  await page.getByRole("combobox", { name: "File" }).selectOption("fast.st");
  await page.getByRole("region", { name: "fast.st" }).getByText("PROGRAM fast").waitFor();
  check("another file can be chosen", true);
  await page.getByRole("combobox", { name: "File" }).selectOption("main.st");

  await page.getByRole("searchbox", { name: "Find a variable" }).pressSequentially("probe.start.pt", hand);
  await page.getByRole("button", { name: "Watch main.probe.start.PT" }).click();
  await page.getByRole("searchbox", { name: "Find a variable" }).fill("main.spindle.programmed");
  await page.getByRole("button", { name: "Watch main.spindle.programmed" }).click();
  const watched = page.getByRole("region", { name: "Watched variables" }).first();
  await watched.getByRole("row").filter({ hasText: "main.probe.start.PT" }).getByText("T#100ms").waitFor();
  check("a variable that is found is watched", true);
  const value = page.getByRole("textbox", { name: "Value to force main.spindle.programmed to" });
  await value.fill("abc");
  await value.press("Enter");
  const wrong = page.getByRole("alertdialog", { name: /Force main.spindle.programmed to abc/ });
  await told(page, "write a whole number 0 .. 65535", () => wrong.getByRole("button", { name: "Force" }).click(), { refused: true });
  check("a wrong value is refused with what is expected", (await forces(url)).length === 0);
  await value.fill("1234");
  await value.press("Enter");
  await page.getByRole("alertdialog", { name: /Force main.spindle.programmed to 1234/ }).getByRole("button", { name: "Force" }).click();
  await eventually("it is forced", async () => (await forces(url)).length === 1);
  await watched.getByRole("row").filter({ hasText: "main.spindle.programmed" }).getByText("1234").waitFor();
  await watched.locator("[data-test=plc-forces]").filter({ hasText: "1 forced" }).waitFor();
  check("a forced value has its mark", await appears(watched.getByRole("row").filter({ hasText: "main.spindle.programmed" }).getByText("forced", { exact: true })));
  await shot(page, "plc-programs");
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)], ["axe-core", await inaccessible(page)]])
    check(`PLC programs: ${what} ${found}`, found.length === 0);
  await page.getByRole("button", { name: "Release main.spindle.programmed" }).click();
  await eventually("it is released", async () => (await forces(url)).length === 0);
  check("and is released", true);

  await page.getByRole("textbox", { name: "Scans" }).fill("200");
  await page.getByRole("button", { name: "Record", exact: true }).click();
  // Virtual time advances while an axis moves.
  await post(url, "channels/0/mode", { mode: "MDI" });
  await post(url, "channels/0/mdi", { line: "G53 G1 X5 F1000" });
  await page.locator("[data-test=plc-trace]").filter({ hasText: "200 of 200 scans" }).waitFor();
  check("a trace is plotted", (await page.getByRole("img", { name: "Trace" }).getAttribute("data-lanes")) === "2");
  await shot(page, "plc-trace");
  await page.getByRole("button", { name: "Task times", exact: true }).click();
  const tasks = page.getByRole("region", { name: "Task times" }).last();
  const main = tasks.getByRole("row").filter({ hasText: "main" });
  await main.getByText("/ 200").waitFor();
  const whole = await tasks.getByRole("row").filter({ hasText: "whole scan" }).getByRole("cell").allTextContents();
  check(`the scan has its last and worst time and its limit ${whole}`, Number(whole[1]) > 0 && Number(whole[2]) >= Number(whole[1]) && whole[3] === "1000");
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)], ["axe-core", await inaccessible(page)]])
    check(`task times: ${what} ${found}`, found.length === 0);
  await page.getByRole("button", { name: "Uses", exact: true }).click();
  const used = page.getByRole("region", { name: "Uses" }).last().getByRole("row");
  await used.filter({ hasText: "written" }).filter({ hasText: "programmed :=" }).first().waitFor();
  check("the cross reference has the line that writes a variable", true);
  await page.getByRole("button", { name: "Inputs", exact: true }).click();
  const key = page.getByRole("switch", { name: "Switch feed_hold_button" });
  const agree = () => page.getByRole("alertdialog", { name: /^Force %X0.2 to / }).getByRole("button", { name: "Force" }).click();
  await key.click();
  await agree();
  await page.getByRole("switch", { name: "Switch feed_hold_button", checked: true }).waitFor();
  await eventually("the input is forced", async () => (await forces(url)).includes("%X0.2"));
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)], ["axe-core", await inaccessible(page)]])
    check(`inputs: ${what} ${found}`, found.length === 0);
  await shot(page, "plc-inputs");
  await key.click();
  await agree();
  await page.getByRole("switch", { name: "Switch feed_hold_button", checked: false }).waitFor();
  await page.getByRole("button", { name: "Release feed_hold_button" }).click();
  await eventually("and released", async () => (await forces(url)).length === 0);
  check("an input is switched by hand and given back", true);
  await simulator(page, url);
  await page.getByRole("button", { name: "Trace", exact: true }).click();
  await load(page, url);
  await page.getByRole("button", { name: "Registers and services" }).click();
  await page.getByRole("region", { name: "PLC registers" }).first().waitFor();
  check(`the PLC's view logs no errors ${page.complaints}`, page.complaints.length === 0);
  await page.context().close();
}

// The devices of configs/machines/ac-table/plc/devices.yaml, by their names.
async function simulator(page, url) {
  const agree = (path, value) => page.getByRole("alertdialog", { name: new RegExp(`^Force ${path} to ${value}\\?`) }).getByRole("button", { name: "Force" }).click();
  const device = (name) => page.getByRole("row").filter({ has: page.getByRole("cell", { name, exact: true }) });
  await page.getByRole("combobox", { name: "feed_override: position" }).selectOption("50");
  await agree("%X120", "9");
  await device("feed override rotary switch").getByText("value 50").waitFor();
  check("a rotary switch is turned to a position by what stands there", true);
  const wheel = device("handwheel handwheel");
  await wheel.getByText(/counter \d+/).waitFor();
  const counter = Number(/counter (\d+)/.exec(await wheel.innerText())[1]);
  await page.getByRole("button", { name: "Turn handwheel by 10", exact: true }).click();
  await agree("%X127", String((counter + 10) % 256));
  await wheel.getByText(`counter ${(counter + 10) % 256}`).waitFor();
  await page.getByRole("button", { name: "Turn handwheel by -1", exact: true }).click();
  await wheel.getByText(`counter ${(counter + 9) % 256}`).waitFor();
  check("the handwheel is turned to and fro, after one question", true);
  // Without waiting for the values between.
  for (let i = 0; i < 5; ++i) await page.getByRole("button", { name: "Turn handwheel by 1", exact: true }).click();
  await wheel.getByText(`counter ${(counter + 14) % 256}`).waitFor();
  check("five counts one after the other are five", true);
  await page.getByRole("combobox", { name: "magazine: place" }).selectOption("3");
  await agree("simulation.device_magazine.place", "3");
  await device("magazine magazine").getByText("place 3").first().waitFor();
  check("the magazine is brought to a place", true);
  await page.getByRole("switch", { name: "Switch coolant: fault" }).click();
  await agree("%R60.5", "TRUE");
  await page.getByRole("switch", { name: "Switch coolant: fault", checked: true }).waitFor();
  check("a device has its fault", (await forces(url)).includes("%R60.5"));
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)], ["axe-core", await inaccessible(page)]])
    check(`simulated devices: ${what} ${found}`, found.length === 0);
  await shot(page, "plc-simulator");
  // A bit that no program writes stays as the hand has left it.
  await page.getByRole("switch", { name: "Switch coolant: fault" }).click();
  await agree("%R60.5", "FALSE");
  await page.getByRole("switch", { name: "Switch coolant: fault", checked: false }).waitFor();
  for (const name of ["feed_override: position", "handwheel: counts", "magazine: place", "coolant: fault"]) await page.getByRole("button", { name: `Release ${name}` }).click();
  await eventually("all are given back", async () => (await forces(url)).length === 0);
  await device("magazine magazine").getByText("place 3").first().waitFor();
  check("the magazine stays where the hand has left it", true);
}

const programs = (url) => fetch(`${url}api/plc/programs`).then((answer) => answer.json());
const source = (url, name) => fetch(`${url}api/plc/programs/${name}`).then((answer) => answer.text());
const state = (page, text) => page.locator("[data-test=plc-load-state]").filter({ hasText: text }).waitFor();

async function load(page, url) {
  await page.getByRole("button", { name: "Change programs" }).click();
  const pane = page.getByRole("region", { name: "Change programs" });
  const before = await source(url, "main.st");
  const chosen = async (text) => pane.getByLabel("Choose files").last().setInputFiles({ name: "main.st", mimeType: "text/plain", buffer: Buffer.from(text) });
  await pane.getByText("Edit the sources or choose files.", { exact: false }).waitFor();
  await pane.locator(".cm-content .nc-code").filter({ hasText: "PROGRAM" }).waitFor();
  check("the editor colours the words of Structured Text", true);
  await chosen(before.replace("END_PROGRAM", "no_such_lamp := TRUE;\nEND_PROGRAM"));
  await pane.getByRole("button", { name: "Check", exact: true }).click();
  await state(page, "The programs have errors");
  const error = pane.getByRole("button", { name: /main\.st:\d+:1 there is no variable 'no_such_lamp'/ });
  await error.click();
  await pane.locator(".cm-activeLine").filter({ hasText: "no_such_lamp" }).waitFor();
  check("an error leads to its line", await pane.getByRole("button", { name: "Take over" }).isDisabled());
  check("and nothing has changed", (await programs(url)).changes === 0);
  // The variable `extra` is new, and the lamp of the coolant shows something else.
  const text = before.replace("PROGRAM main", "PROGRAM main\nVAR extra : INT; END_VAR").replace("END_PROGRAM", "extra := extra + 1;\n%R300 := 7;\nEND_PROGRAM");
  await chosen(text);
  await pane.getByRole("combobox", { name: "File" }).getByRole("option", { name: "main.st – changed" }).waitFor({ state: "attached" });
  await pane.getByRole("button", { name: "Check", exact: true }).click();
  await pane.getByText("main.extra (INT) is new: it begins with its initial value").waitFor();
  await state(page, "Read this before you take over");
  check("what is not kept is said before", true);
  await pane.getByRole("button", { name: "Compare", exact: true }).click();
  await pane.getByText(/register R300: 0 and 7/).waitFor();
  check("the comparison names the difference, and a take-over needs consent", await pane.getByRole("button", { name: "Take over" }).isDisabled());
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)], ["axe-core", await inaccessible(page)]])
    check(`new programs: ${what} ${found}`, found.length === 0);
  await shot(page, "plc-load");
  await pane.getByRole("checkbox", { name: "Take over with these differences" }).check();
  await pane.getByRole("button", { name: "Take over" }).click();
  await page.getByRole("alertdialog", { name: /Take over the new programs/ }).getByRole("button", { name: "Take over" }).click();
  await eventually("the new programs run", async () => (await programs(url)).changes === 1);
  check("their source is shown", (await source(url, "main.st")) === text);
  await page.getByText("loaded online, 1 changes").waitFor();
  await page.getByRole("button", { name: "Change programs" }).click();
  await pane.getByRole("button", { name: "Undo the last change" }).click();
  await pane.getByText(/main\.extra .* its value is lost/).waitFor();
  await pane.getByRole("button", { name: "Compare", exact: true }).click();
  await state(page, "Both run with the same inputs");
  const accepts = pane.getByRole("checkbox", { name: "Take over with these differences" });
  if (await pane.getByText(/ and /).filter({ hasText: "register" }).count() > 0) await accepts.check();
  await pane.getByRole("button", { name: "Take over" }).click();
  await page.getByRole("alertdialog").getByRole("button", { name: "Take over" }).click();
  await eventually("the programs before run again", async () => (await source(url, "main.st")) === before);
  check("and are taken back", true);
}

async function german(browser, url) {
  const page = await openPage(browser, url, { locale: "de-DE" });
  await open(page, "Diagnose", "SPS-Programme");
  await page.getByRole("button", { name: "Taskzeiten" }).click();
  await page.getByRole("row").filter({ hasText: "ganzer Zyklus" }).waitFor();
  await page.getByRole("button", { name: "Programme ändern" }).click();
  await page.getByRole("button", { name: "Prüfen", exact: true }).click();
  await state(page, "Keine Fehler");
  await page.getByRole("button", { name: "Beenden", exact: true }).click();
  await eventually("the load is dropped", async () => (await fetch(`${url}api/plc/load`).then((answer) => answer.json())).phase === "NO_LOAD");
  const cut = await overflowing(page);
  check(`German: PLC programs fit ${cut}`, cut.length === 0);
  await page.context().close();
}

async function chinese(browser, url) {
  const page = await openPage(browser, url, { locale: "zh-CN" });
  await open(page, "诊断", "PLC 程序");
  await page.getByRole("searchbox", { name: "查找变量" }).fill("main.code");
  await page.getByRole("button", { name: "监视 main.code" }).click();
  await page.getByRole("region", { name: "监视的变量" }).first().getByRole("row").filter({ hasText: "main.code" }).getByText("65535").waitFor();
  const cut = await overflowing(page);
  check(`Chinese: PLC programs fit ${cut}`, cut.length === 0);
  await page.context().close();
}

export async function plc(browser, url) {
  await english(browser, url);
  await chinese(browser, url);
  await german(browser, url);
}
