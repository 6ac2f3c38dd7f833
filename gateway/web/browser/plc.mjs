// SPDX-License-Identifier: Apache-2.0
// The programs of the PLC on a real cluster: source with live values, search, force and release, trace; in English and
// Chinese.
import { check, eventually, inaccessible, openPage, overflowing, post, shot, smallTargets } from "./harness.mjs";

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
  await page.locator('[data-path="main.changer.Q"], [data-path^="main."]').first().waitFor();
  const beside = source.locator(".plc-line").filter({ hasText: "is_m3 := code = 3" });
  await beside.getByText(/is_m3 = FALSE/).waitFor();
  await beside.getByText(/code = 65535/).waitFor();
  check("with the live values of a line beside it", true);
  await page.getByRole("combobox", { name: "File" }).selectOption("fast.st");
  await page.getByRole("region", { name: "fast.st" }).getByText("PROGRAM fast").waitFor();
  check("another file can be chosen", true);
  await page.getByRole("combobox", { name: "File" }).selectOption("main.st");

  await page.getByRole("searchbox", { name: "Find a variable" }).pressSequentially("probe_start.pt", { delay: 120 });
  await page.getByRole("button", { name: "Watch main.probe_start.PT" }).click();
  await page.getByRole("searchbox", { name: "Find a variable" }).fill("main.speed");
  await page.getByRole("button", { name: "Watch main.speed" }).click();
  const watched = page.getByRole("region", { name: "Watched variables" }).first();
  await watched.getByRole("row").filter({ hasText: "main.probe_start.PT" }).getByText("T#100ms").waitFor();
  check("a variable that is found is watched", true);
  const value = page.getByRole("textbox", { name: "Value to force main.speed to" });
  await value.fill("abc");
  await value.press("Enter");
  await page.getByRole("alertdialog", { name: /Force main.speed to abc/ }).getByRole("button", { name: "Force" }).click();
  await page.locator(".notice.refused").filter({ hasText: "write a whole number 0 .. 65535" }).waitFor();
  check("a wrong value is refused with what is expected", (await forces(url)).length === 0);
  await value.fill("1234");
  await value.press("Enter");
  await page.getByRole("alertdialog", { name: /Force main.speed to 1234/ }).getByRole("button", { name: "Force" }).click();
  await eventually("it is forced", async () => (await forces(url)).length === 1);
  await watched.getByRole("row").filter({ hasText: "main.speed" }).getByText("1234").waitFor();
  await watched.locator("[data-test=plc-forces]").filter({ hasText: "1 forced" }).waitFor();
  check("a forced value has its mark", await watched.getByRole("row").filter({ hasText: "main.speed" }).getByText("forced", { exact: true }).isVisible());
  await shot(page, "plc-programs");
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)], ["axe-core", await inaccessible(page)]])
    check(`PLC programs: ${what} ${found}`, found.length === 0);
  await page.getByRole("button", { name: "Release main.speed" }).click();
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
  await page.getByRole("button", { name: "Registers and services" }).click();
  await page.getByRole("region", { name: "PLC registers" }).first().waitFor();
  check(`the PLC's view logs no errors ${page.complaints}`, page.complaints.length === 0);
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
}
