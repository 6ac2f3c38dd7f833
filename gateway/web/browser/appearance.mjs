// SPDX-License-Identifier: Apache-2.0
// Every view in three sizes and two languages, dark and light: nothing is cut, everything can be touched, the keys that
// stop are free, the digits are as large as promised, and axe-core has no serious findings.
import {
  check as judged, coveredStops, drawn, inaccessible, interceptStream, openPage, overflowing, pretend, settled, shot, smallTargets, stopPlaces,
} from "./harness.mjs";

const languages = {
  en: { locale: "en-GB", views: ["Operate", "3D", "Programs", "Setup", "Parameters", "Analysis", "Diagnosis"], estop: "Emergency stop", hold: "Feed hold", start: "Cycle start" },
  de: { locale: "de-DE", views: ["Bedienen", "3D", "Programme", "Einrichten", "Parameter", "Analyse", "Diagnose"], estop: "Not-Halt", hold: "Vorschub-Halt", start: "NC-Start" },
};
const sizes = [
  { size: [1280, 800], digits: 48, operates: true },
  { size: [1920, 1080], digits: 72, operates: true },
  { size: [390, 844], digits: 36, operates: false },
];

/** Of each view, in their order: what is there when it is loaded and has read what it shows. */
const contents = [
  "[data-test=position-X]", "[data-test=segments]", ".choose", ".cell", "[data-parameter]", ".sampling-keys", ".registers, .plc p",
];

/** Goes to a view, and waits for what it has to show. */
async function open(page, index, view) {
  await page.getByRole("navigation").getByRole("button", { name: view, exact: true }).click();
  await page.locator(contents[index]).first().waitFor();
  if (index === 1) await page.locator("[data-test=scene][data-frames]").waitFor();
  await settled(page);
}

const failures = [];

/** The other views are looked at, too, when one is wrong. */
function check(what, condition) {
  try {
    judged(what, condition);
  } catch (error) {
    failures.push(error.message);
  }
}

/** Keys of the navigation that are not whole on the screen. */
const offScreen = (page) =>
  page.getByRole("navigation").getByRole("button").evaluateAll((keys) =>
    keys.map((key) => [key.textContent, key.getBoundingClientRect()])
      .filter(([, box]) => box.left < 0 || box.top < 0 || box.right > innerWidth || box.bottom > innerHeight)
      .map(([name]) => name));

/** Two spindles, and the second one begins to follow the first: no key moves, and both lines are whole. */
async function twoSpindles(page, stream, where) {
  const turns = { condition: "SPINDLE_ACCELERATING", homed: true, angle: 359.99, gear: 2, reference: -4000, master: -1, synchronization_error: 0, correction: 0 };
  const follows = { ...turns, condition: "SPINDLE_SYNCHRONIZING", master: 0, synchronization_error: -179.999, correction: -1.5 };
  const keys = () => page.evaluate(() =>
    [...document.querySelectorAll("main button")].map((key) => key.getBoundingClientRect()).map(({ x, y, width, height }) => [x, y, width, height].map(Math.round).join()).join(" "));
  pretend(stream, { drive: { spindle_speed: [-3999.6, -3999.6], spindles: [turns, turns] } });
  await page.locator("[data-test=spindle-S2]").waitFor();
  await drawn(page);
  const before = await keys();
  pretend(stream, { drive: { spindles: [turns, follows] } });
  const coupling = page.locator("[data-test=spindle-S2] .coupling");
  await coupling.waitFor();
  await drawn(page);
  check(`${where}: the keys stay where they are when a spindle begins to follow`, (await keys()) === before);
  check(`${where}: what a spindle follows is whole`, await coupling.evaluate((one) => one.scrollWidth <= one.clientWidth + 1));
  const cut = (await overflowing(page)).filter((part) => /^SECTION\.technology/.test(part));
  check(`${where}: two spindles fit ${cut}`, cut.length === 0);
}

/** Whatever the state bar has to show, the keys that stop are where they were. */
async function still(browser, url, code, { size }) {
  const page = await openPage(browser, null, { size, locale: languages[code].locale });
  const stream = await interceptStream(page);
  const program = `${"long_".repeat(12)}a.nc`;  // 64 letters, as many as a name has
  const path = { x: [], y: [], z: [], line: [], rapid: [], seconds: [], tolerance: 0 };
  const planned = { program, revision: 1, channel: 0, complete: false, seconds: 41_025, moves: 1, lines: { line: [1], begin: [0] }, path };
  await page.route(/long_.*\/plan/, (route) => route.fulfill({ json: planned }));
  await page.goto(url);
  await page.waitForSelector(".positions");
  const where = `${code} ${size.join("x")}`;
  const places = await stopPlaces(page);
  const looks = async (what) => {
    await drawn(page);
    const now = await stopPlaces(page);
    check(`${where} ${what}: the keys that stop are at ${places}, now at ${now}`, now === places);
    const cut = (await overflowing(page)).filter((part) => /^(HEADER|DIV\.facts)/.test(part));
    check(`${where} ${what}: the state bar holds it ${cut}`, cut.length === 0);
  };
  pretend(stream, { run_times: { 0: { ticks: 45_296_000, partial: true } } });
  for (const state of ["IDLE", "RUNNING", "HOLDING", "HELD", "WAITING", "INTERRUPTED"]) {
    pretend(stream, { channels: { 0: { state, mode: "AUTO", program, line: 123456, lines_total: 1234567 } } });
    await page.locator(`[data-test=state][data-state=${state}]`).waitFor();
    for (const time of ["elapsed", "remaining"]) await page.locator(`[data-test=${time}]`).waitFor();
    await looks(state);
  }
  await twoSpindles(page, stream, where);
  pretend(stream, { plc: { emergency_stop: true } });
  await page.locator("[data-test=estop-engaged]").waitFor();
  await looks("emergency stop");
  const edge = await page.locator("[data-test=recover]").evaluate((key) => key.closest(".attention").getBoundingClientRect().right - key.getBoundingClientRect().right);
  check(`${where}: the key that recovers is at the edge, alarm or not: ${edge} px from it`, edge < 20 || size[0] < 720);
  if (code === "de") {
    const text = "Z: following error 1.25 mm, at most 1 mm";
    const alarm = { instance: 3, number: 111, part: 2, severity: "EMERGENCY", reaction: "AXIS_STOP", source: "drive", text, cycle: 1, occurrences: 1, since: "2000-01-01T00:00:00Z" };
    pretend(stream, { alarms: { "3/111/2": alarm } });
    const strip = page.locator("[data-test=attention]");
    await strip.filter({ hasText: "Der Schleppfehler überschreitet seine Grenze" }).waitFor();
    check(`${where}: an alarm is in the language of the page, with its numbers`, (await strip.innerText()).includes(text));
  }
  await page.context().close();
}

async function one(browser, url, code, { size, digits, operates }, colorScheme) {
  const { locale, views, estop, hold, start } = languages[code];
  const page = await openPage(browser, url, { size, locale, colorScheme });
  const where = `${code} ${size.join("x")} ${colorScheme}`;
  check(`${where}: the language of the browser is used`, (await page.locator("html").getAttribute("lang")) === code);
  const height = await page.locator("[data-test=position-X]").evaluate((element) => parseFloat(getComputedStyle(element).fontSize));
  check(`${where}: digits of ${height} px`, height >= digits);
  check(`${where}: cycle start is ${operates ? "" : "not "}offered`, (await page.getByRole("button", { name: start }).isVisible()) === operates);
  const places = await stopPlaces(page);
  for (const [index, view] of views.entries()) {
    await open(page, index, view);
    if (index === 2) {
      await page.getByRole("button", { name: /^rtcp.nc/ }).click();
      await page.getByRole("textbox", { name: /rtcp.nc/ }).waitFor();
      await page.locator("[data-test=check]").filter({ hasText: /\d/ }).waitFor();
      await settled(page);
    }
    // The work offsets are shown first; the other sizes show the other parts.
    if (index === 3 && size !== sizes[0].size) {
      await page.getByRole("tab").nth(size === sizes[1].size ? 1 : 2).click();
      await settled(page);
    }
    for (const name of [estop, hold]) check(`${where} ${view}: ${name} is there`, await page.getByRole("button", { name }).isVisible());
    const covered = await coveredStops(page);
    check(`${where} ${view}: the keys that stop are free ${covered}`, covered.length === 0);
    check(`${where} ${view}: and where they were`, (await stopPlaces(page)) === places);
    const away = await offScreen(page);
    check(`${where} ${view}: every view can be reached ${away}`, away.length === 0);
    const small = await smallTargets(page);
    check(`${where} ${view}: touch targets of 48 px ${small}`, small.length === 0);
    const cut = (await overflowing(page)).filter((part) => operates || /^(HEADER|DIV\.facts|NAV)/.test(part));
    check(`${where} ${view}: nothing is cut ${cut}`, cut.length === 0);
    const findings = await inaccessible(page);
    check(`${where} ${view}: axe-core ${findings}`, findings.length === 0);
    await shot(page, `${["operate", "scene", "programs", "setup", "parameters", "analysis", "diagnosis"][index]}-${size[0]}-${code}-${colorScheme}`);
  }
  check(`${where}: no errors ${page.complaints}`, page.complaints.length === 0);
  await page.context().close();
}

export async function appearance(browser, url) {
  for (const size of sizes)
    for (const [code, colorScheme] of [["en", "dark"], ["de", "light"]]) {
      await still(browser, url, code, size);
      await one(browser, url, code, size, colorScheme);
    }

  const page = await openPage(browser, url);
  await page.getByRole("combobox", { name: "Language" }).selectOption("zh");
  await page.getByRole("button", { name: "循环启动" }).waitFor();
  for (const [index, view] of ["操作", "三维", "程序", "调整", "参数", "分析", "诊断"].entries()) {
    await open(page, index, view);
    const cut = await overflowing(page);
    check(`Chinese fits: ${view} ${cut}`, cut.length === 0);
  }
  await page.getByRole("combobox", { name: "颜色" }).selectOption("light");
  await page.reload();
  await page.getByRole("button", { name: "循环启动" }).waitFor();
  check("language and colours are kept over a reload", (await page.locator("html").getAttribute("data-theme")) === "light");
  await page.context().close();
  if (failures.length > 0) throw new Error(failures.join("\n"));
}
