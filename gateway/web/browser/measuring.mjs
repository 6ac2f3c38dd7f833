// SPDX-License-Identifier: Apache-2.0
// A workpiece measured from the page, on a real cluster with the solids of examples/measuring-cycles: the probe is calibrated in
// the ring gauge, and the boss becomes the zero of G55.
import { appears, check, coveredStops, eventually, hand, inaccessible, mdi, openPage, overflowing, post, runTest, settled, shot, smallTargets } from "./harness.mjs";

const read = (url, path) => fetch(`${url}api/${path}`).then((answer) => answer.json());

async function type(page, name, value) {
  const box = page.getByRole("textbox", { name });
  await box.click();
  await page.keyboard.press("ControlOrMeta+a");
  await box.pressSequentially(value, hand);
}

const results = async (page) => (await page.getByRole("table", { name: "Results of the measuring cycle" }).innerText()).replaceAll("\u2212", "-");

await runTest(async (browser, url) => {
  await post(url, "channels/0/mode", { mode: "MDI" });
  await mdi(url, "G10 L10 P9 R63");
  await mdi(url, "G53 G0 X-80.4 Y0.3 Z-250", { machine: { X: -80.4, Y: 0.3, Z: -250 } });
  await mdi(url, "G43 H9");
  const page = await openPage(browser, url);
  await page.locator('[data-test="view-setup"]').click();
  await page.getByRole("tab", { name: "Measure", exact: true }).click();
  const measure = page.getByRole("button", { name: "Measure", exact: true });
  check("without a diameter Measure is dark", await measure.isDisabled());
  await page.getByRole("button", { name: "Bore", exact: true }).click();
  check("before the calibration it says so", await appears(page.getByText(/The probe is not calibrated/)));
  await page.getByRole("button", { name: "Calibrate", exact: true }).click();
  await page.getByRole("button", { name: "Probe on (M40)" }).click();
  await eventually("the probe is on", async () => (await read(url, "channels/0")).state === "IDLE");
  await mdi(url, "G53 G1 Z-328 F3000", { machine: { Z: -328 } });
  await type(page, "Diameter, mm", "50");
  await type(page, "Radius of the ball, mm", "3");
  check("the line is shown before it is sent", (await page.locator("[data-test=measure-line]").innerText()) === "G65 P9810 D50 R3");
  await measure.click();
  // The ball less the pre-travel of 8 um and the way of 1 ms at 50 mm/min.
  await eventually(async () => `the radius of the touch is 2.9912: ${await results(page).catch(() => "no results")}`, async () => /2\.991[12]/.test(await results(page).catch(() => "")));
  check(`the probe is calibrated: ${(await results(page)).replaceAll(/\s+/g, " ")}`, true);

  await mdi(url, "G53 G1 Z-250", { machine: { Z: -250 } });
  await mdi(url, "G53 G1 X-60 Y90.7 Z-290", { machine: { X: -60, Y: 90.7, Z: -290 } });
  await page.getByRole("button", { name: "Boss", exact: true }).click();
  await type(page, "Diameter, mm", "32");
  // G54 of the machine is at Z-380: the probe touches in the middle of the boss.
  await type(page, "Height Z, mm", "0");
  await page.getByRole("combobox", { name: "Set work offset" }).selectOption("G55");
  check("the work offset is in the line", (await page.locator("[data-test=measure-line]").innerText()) === "G65 P9812 D32 Z0 S2");
  await measure.click();
  await eventually(async () => `the boss is measured: ${await results(page)}`, async () => /32\.500/.test(await results(page)));
  check(`the boss has its diameter: ${(await results(page)).replaceAll(/\s+/g, " ")}`, true);
  const { offsets } = await read(url, "work-offsets");
  const set = offsets.find(({ channel, index }) => channel === 0 && index === 1).values;
  check(`its centre is the zero of G55: ${set.slice(0, 2)}`, Math.abs(set[0] + 60.5) < 0.001 && Math.abs(set[1] - 90.25) < 0.001);
  await page.locator(".notice").waitFor({ state: "detached" });
  await settled(page);
  await shot(page, "measuring");
  for (const [what, found] of [["nothing is cut", await overflowing(page)], ["touch targets of 48 px", await smallTargets(page)],
    ["stops are free", await coveredStops(page)], ["axe-core", await inaccessible(page)]])
    check(`measuring: ${what} ${found}`, found.length === 0);
  check(`the view logs no errors ${page.complaints}`, page.complaints.length === 0);
});
