// SPDX-License-Identifier: Apache-2.0
// One station operates: two browsers at a machine without users.
import { check, coveredStops, eventually, inaccessible, openPage, overflowing, pressDown, runTest, shot } from "./harness.mjs";

const operator = (page) => page.locator("[data-test=operator]").innerText();
const name = (page) => page.locator("[data-test=operator]");

async function press(page, key) {
  await pressDown(page, page.getByRole("button", { name: key }));
  await page.mouse.up();
}

async function twoBrowsers(browser, url) {
  const one = await openPage(browser, url);
  const other = await openPage(browser, url);
  await name(one).filter({ hasText: "No station operates" }).waitFor();
  check("nobody operates at the start", true);
  await one.getByRole("button", { name: "Auto", exact: true }).click();
  await name(one).filter({ hasText: "You operate" }).waitFor();
  check("the first order takes the right", true);
  await name(other).filter({ hasText: /^station \d+ \(127\.0\.0\.1\) operates$/ }).waitFor();
  check("the other browser shows who operates", true);
  const dark = async (page, key) => page.getByRole("button", { name: key, exact: true }).isDisabled();
  for (const key of ["Auto", "Cycle start", "Reset", "Execute"]) check(`${key} is dark where one watches`, await dark(other, key));
  check("and bright where one operates", !(await dark(one, "Cycle start")));
  const covered = await coveredStops(other);
  check(`the keys that stop are free ${covered}`, covered.length === 0);
  await one.getByRole("button", { name: "Cycle start" }).click();
  await eventually("it runs", async () => (await other.locator("[data-test=state]").getAttribute("data-state")) === "RUNNING");
  await press(other, "Feed hold");
  await eventually("the station that watches holds", async () => (await one.locator("[data-test=state]").getAttribute("data-state")) === "HELD");
  check("feed hold works where one watches", true);
  await other.getByRole("navigation").getByRole("button", { name: "Setup", exact: true }).click();
  await other.getByRole("note").filter({ hasText: /operates: this station watches/ }).waitFor();
  check("a work offset is dark and says why", await other.getByLabel("G54 X").isDisabled());
  await shot(other, "operating-watches");
  const findings = await inaccessible(other);
  check(`what is dark has names ${findings}`, findings.length === 0);
  await other.getByRole("navigation").getByRole("button", { name: "Operate", exact: true }).click();
  const cut = await overflowing(other);
  check(`nothing is cut ${cut}`, cut.length === 0);

  await other.getByRole("button", { name: "Take over" }).click();
  await name(other).filter({ hasText: "You operate" }).waitFor();
  await name(one).filter({ hasText: /operates$/ }).waitFor();
  check("the right is taken over, and the one before is told", await dark(one, "Cycle start"));
  await shot(one, "operating-taken-over");
  await other.getByRole("button", { name: "Give back" }).click();
  await name(one).filter({ hasText: "No station operates" }).waitFor();
  check("and given back", !(await dark(one, "Reset")));
  await other.getByRole("button", { name: "Reset", exact: true }).click();
  await name(one).filter({ hasText: /operates$/ }).waitFor();
  await other.context().close();
  await eventually("a browser that is closed loses the right", () => operator(one), (shown) => shown === "No station operates");
  check("a browser that is closed loses the right when its lease ends", true);
  check(`no errors ${one.complaints}`, one.complaints.length === 0);
  await one.context().close();
}

await runTest(twoBrowsers, { settings: "operating_right: one\n" });
