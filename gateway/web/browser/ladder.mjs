// SPDX-License-Identifier: Apache-2.0
// Drawn programs of the PLC on a real cluster that runs examples/plc-ladder (main) and lamp.xml (fast): the ladder with
// power flow, blocks with values, a chart with its active step.
import { check, eventually, inaccessible, openPage, overflowing, post, runTest, shot, smallTargets } from "./harness.mjs";

const force = (url, values) => post(url, "plc/force", { values: Object.entries(values).map(([path, value]) => ({ path, value })) });

async function open(page, view, programs, label, file) {
  await page.getByRole("navigation").getByRole("button", { name: view, exact: true }).click();
  await page.getByRole("button", { name: programs, exact: true }).click();
  await page.getByRole("combobox", { name: label }).first().selectOption(file);
}

async function drawn(page, url) {
  await open(page, "Diagnosis", "PLC programs", "File", "coolant.xml");
  const ladder = page.getByRole("group", { name: "CoolantPump LD" });
  const is = (name) => ladder.getByRole("img", { name, exact: true }).first().waitFor();
  // As after a start, also in a second run.
  await force(url, { "%X18.0": "FALSE", "%X18.1": "FALSE", "%X18.2": "FALSE", "%X18.3": "FALSE", "%X18.7": "FALSE", reset_button: "TRUE" });
  // It waits for an edge, which the values do not show.
  await is("contact reset = TRUE power not known");
  await force(url, { reset_button: "FALSE" });
  await is("contact start = FALSE no power");
  await is("contact not stop = FALSE no power");
  await is("coil pump = FALSE no power");
  check("a ladder is drawn, with the instance of its function block", (await page.getByRole("combobox", { name: "Instance" }).inputValue()) === "main.coolant");
  check("the force is accepted", (await force(url, { "%X18.0": "TRUE", "%X18.2": "TRUE", "%X18.3": "TRUE" })).ok);
  await is("contact start = TRUE power");
  await is("contact pump = TRUE power");
  await is("contact not stop = FALSE power");
  await is("coil pump = TRUE power");
  await is("contact not pressure = TRUE no power");
  check("power flows through contacts and branches to the coil", (await ladder.getByRole("img", { name: "coil pump", exact: false }).first().getAttribute("data-flow")) === "on");
  await ladder.getByRole("img", { name: "contact start = TRUE power", exact: true }).focus();
  await page.keyboard.press("Tab");
  check("the keyboard goes from element to element", await page.evaluate(() => document.activeElement?.getAttribute("role") === "img"));
  await shot(page, "plc-ladder");
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)], ["axe-core", await inaccessible(page)]])
    check(`drawn programs: ${what} ${found}`, found.length === 0);
  await force(url, { "%X18.3": "FALSE" });
  // Two seconds later, which pass at once in virtual time, the missing pressure is a fault: it ends the pump, and that
  // the power of the timer.
  await is("contact not no_pressure = TRUE no power");
  await is("coil no_pressure = TRUE no power");
  await ladder.locator(".block").filter({ hasText: "T#2s" }).waitFor();
  check("a block has the values of its pins", true);
  await page.getByRole("combobox", { name: "Unit" }).selectOption("main");
  const blocks = page.getByRole("group", { name: "main FBD" });
  await blocks.getByRole("img", { name: "variable %X18.0 = TRUE forced" }).waitFor();
  await blocks.locator(".block").filter({ hasText: "CoolantPump" }).filter({ hasText: "TRUE" }).waitFor();
  check("a function block diagram has its values, and forced ones are marked", true);
  await page.getByRole("button", { name: "Drawing", exact: true }).click();
  await page.getByRole("region", { name: "coolant.xml" }).getByText("<project").waitFor();
  check("its text can be read too", true);
  await page.getByRole("button", { name: "Drawing", exact: true }).click();

  await page.getByRole("combobox", { name: "File" }).selectOption("lamp.xml");
  const chart = page.getByRole("group", { name: "fast SFC" });
  await chart.getByRole("img", { name: "step dark = TRUE", exact: true }).waitFor();
  await chart.getByRole("img", { name: "macro step light = FALSE", exact: true }).waitFor();
  const within = page.getByRole("group", { name: "fast light SFC" });
  await force(url, { "%X18.7": "TRUE" });
  await within.getByRole("img", { name: "step bright = TRUE", exact: true }).waitFor();
  await within.getByRole("img", { name: "step half = FALSE", exact: true }).waitFor();
  await chart.getByRole("img", { name: "macro step light = TRUE", exact: true }).waitFor();
  await chart.getByRole("img", { name: "step dark = FALSE", exact: true }).waitFor();
  check("a chart shows its active step, and the inside of its macro step is drawn with it", true);
  await shot(page, "plc-chart");
  const watched = page.getByRole("searchbox", { name: "Find a variable" });
  await watched.fill("main.coolant.pump");
  await page.getByRole("button", { name: "Watch main.coolant.pump BOOL" }).click();
  await page.getByRole("button", { name: "Uses", exact: true }).click();
  const uses = page.getByRole("region", { name: "Uses" }).last().getByRole("row");
  await uses.filter({ hasText: "coolant.xml:55" }).filter({ hasText: "written" }).waitFor();
  check("the cross reference has the coil", (await uses.filter({ hasText: "coolant.xml" }).count()) >= 3);
  check(`the drawing logs no errors ${page.complaints}`, page.complaints.length === 0);
}

await runTest(async (browser, url) => {
  const page = await openPage(browser, url);
  await drawn(page, url);
  await page.context().close();
  for (const [locale, colorScheme, view, programs, file, element] of [
    ["de-DE", "light", "Diagnose", "SPS-Programme", "Datei", "Kontakt start = TRUE Strom"],
    ["zh-CN", "light", "诊断", "PLC 程序", "文件", "触点 start = TRUE 有能流"],
  ]) {
    const other = await openPage(browser, url, { locale, colorScheme });
    await open(other, view, programs, file, "coolant.xml");
    await other.getByRole("group", { name: "CoolantPump LD" }).getByRole("img", { name: element, exact: true }).waitFor();
    const wrong = [...(await overflowing(other)), ...(await inaccessible(other))];
    check(`${locale}: the drawing fits, in light colours too ${wrong}`, wrong.length === 0);
    await shot(other, `plc-ladder-${locale}`);
    await other.context().close();
  }
  await post(url, "plc/release", {});
  await eventually("nothing is forced", async () => (await fetch(`${url}api/plc/forces`).then((answer) => answer.json())).values.length === 0);
});
