// SPDX-License-Identifier: Apache-2.0
// The page in a real browser against a real gateway. By default it starts a gateway and a fake cluster of its own;
// with TRUNNION_URL it uses the cluster that runs there and leaves out what only the fake one can be asked.
import { analysis } from "./analysis.mjs";
import { appearance } from "./appearance.mjs";
import {
  appears, check, cluster, coveredStops, eventually, hand, openPage, overflowing, pressDown, runTest, settled, shot, signalGateway,
  streamed, told, TRUNNION_URL,
} from "./harness.mjs";
import { operate } from "./operate.mjs";
import { parameters } from "./parameters.mjs";
import { plc } from "./plc.mjs";
import { programs } from "./programs.mjs";
import { scene } from "./scene.mjs";
import { setup } from "./setup.mjs";

/** How the parts that show values are drawn. */
const coloured = (page) =>
  page.evaluate(() => [...document.querySelectorAll("header > :not(.stops), .attention, main")].map((element) => getComputedStyle(element).filter));

/** Texts outside `selector` that are at least as large as it. */
const asLargeAs = (page, selector) =>
  page.evaluate((wanted) => {
    const size = (element) => parseFloat(getComputedStyle(element).fontSize);
    const largest = document.querySelector(wanted);
    return [...document.querySelectorAll("body *")]
      .filter((element) => element.getClientRects().length > 0 && !element.contains(largest) && element.textContent && size(element) >= size(largest))
      .map((element) => `${element.tagName}.${element.className} ${size(element)}`);
  }, selector);

/** Keys and fields that `selector`, which is shown, lies over. */
const coveredKeys = (page, selector) =>
  page.evaluate((what) => {
    const over = document.querySelector(what)?.getBoundingClientRect();
    if (!over) return [];
    return [...document.querySelectorAll("button, input, select, textarea")]
      .filter((key) => key.getClientRects().length > 0)
      .filter((key) => {
        const box = key.getBoundingClientRect();
        return box.left < over.right && over.left < box.right && box.top < over.bottom && over.top < box.bottom;
      })
      .map((key) => key.getAttribute("aria-label") ?? key.textContent);
  }, selector);

async function run(page, url) {
  const text = (selector) => page.locator(selector).first().innerText();
  const shown = (name) => page.locator(`[data-test="${name}"]`).getAttribute(`data-${name}`);
  const at = (name) => page.locator(`[data-test="${name}"]`);
  const titled = (shown) => shown.length > 0 && (TRUNNION_URL !== undefined || shown === "Gateway test");
  const machine = await eventually("the machine has its title", () => text('[data-test="machine"]'), titled);
  await eventually("and the tab of the browser has it, too", () => page.title(), (title) => title === machine);
  check("and it is said that nobody needs to log in", TRUNNION_URL !== undefined || (await appears(page.getByText("no login", { exact: true }))));
  await eventually("nothing covers the page when the connection is there", async () => (await page.locator(".lost").count()) === 0);
  check("nothing covers the page when the connection is there", true);
  const refuse = page.waitForResponse((response) => response.url().endsWith("/mdi"));
  await at("mdi").fill("?? X1");
  await told(page, /^MDI:(?!\s*MDI)/, () => at("mdi-send").click(), { refused: true });
  check("bad MDI is answered with 409 or 400", [400, 409].includes((await refuse).status()));
  check("and the reason is on the page", true);
  check("and the line stays to be corrected", (await at("mdi").inputValue()) === "?? X1");
  const under = await coveredKeys(page, ".notice");
  check(`and covers no key ${under}`, under.length === 0);
  await at("view-diagnosis").click();
  await page.locator(".notice").waitFor({ state: "detached" });
  check("and is not taken into another view", true);
  await at("view-operate").click();
  await at("mdi").fill("");

  if (!TRUNNION_URL) {
    await at("mode-AUTO").click();
    await eventually("automatic mode", async () => (await shown("mode")) === "AUTO");
    await at("cycle-start").click();
    await eventually("the request arrives", () => cluster.includes("CYCLE_START"));
    check("cycle start arrives at the channel", true);
    await eventually("running", async () => (await shown("state")) === "RUNNING");
    const seen = new Set();
    await eventually("positions change", async () => seen.add(await text('[data-test="position-X"]')).size >= 5);
    check("positions change", true);
    const marked = await text('[data-test="current-line"]');
    await eventually("the current line moves", async () => (await text('[data-test="current-line"]')) !== marked);
    check("the current line is shown and moves", /^G1 X/.test(marked));
    // Later in the circle the positions have all their digits and signs.
    await eventually("the widest positions are shown", async () => {
      const [x, c] = [await text('[data-test="position-X"]'), await text('[data-test="position-C"]')];
      return [x, c].map((shown) => Number(shown.replace("\u2212", "-")));
    }, ([x, c]) => x < -10 && c >= 100);
    const covered = await overflowing(page);
    check(`everything fits at 1280x800 ${covered}`, covered.length === 0);
    await shot(page, "operate");
    await at("plots").click();
    await page.locator(".plots canvas").nth(1).waitFor();
    await streamed(page, 5);
    await shot(page, "plots");
    await page.getByRole("tab", { name: "Tool path" }).click();

    await at("functions").click();
    await at("dry-run").click();
    await at("lock-X").click();
    await eventually("dry run and lock are shown", async () => {
      const shown = (await at("detail").count()) > 0 ? await text('[data-test="detail"]') : "";
      return shown.includes("dry run") && shown.includes("lock X");
    });
    check("what changes the program is shown beside it", true);
    await at("handwheel-offset").click();
    await at("wheel+").click();
    await eventually("the wheel arrives", () => cluster.includes("HANDWHEEL"));
    await at("from-line").fill("40");
    await at("search-line").click();
    await eventually("the line is asked for", () => cluster.includes("START_FROM_LINE"));
    const covered_by_functions = await overflowing(page);
    check(`the functions fit ${covered_by_functions}`, covered_by_functions.length === 0);
    await shot(page, "functions");
    await at("dry-run").click();
    await at("lock-X").click();
    await at("handwheel-offset").click();
    await page.getByRole("tab", { name: "Tool path" }).click();
    await at("cycle-start").click();
    await eventually("running again", async () => (await shown("state")) === "RUNNING");

    await page.keyboard.press("Escape");
    await eventually("held by Escape", async () => (await shown("state")) === "HELD");
    await at("cycle-start").click();
    await eventually("running once more", async () => (await shown("state")) === "RUNNING");

    await at("feed-hold").click();
    await eventually("held", async () => (await shown("state")) === "HELD");
    check("feed hold holds", true);
    await at("reset").click();
    await eventually("reset", async () => (await shown("state")) === "IDLE");

    await at("mode-JOG").click();
    await eventually("jog mode", async () => (await shown("mode")) === "JOG");
    await pressDown(page, at("jog-X+"));
    await eventually("the jog arrives", () => cluster.includes("JOG_AXIS"));
    // Every 0.08 s one: a second.
    await eventually("the held key is renewed", () => cluster.split("JOG_RENEW").length - 1, (renewals) => renewals >= 12);
    check("a held key is one movement that goes on", !cluster.includes("JOG_STOP") && cluster.split("JOG_AXIS").length === 2);
    await page.mouse.up();
    await eventually("the stop arrives", () => cluster.includes("JOG_STOP"));
    check("releasing the key stops it", true);

    await at("mode-REF").click();
    await at("home-all").filter({ hasText: "X Y Z A C" }).waitFor();
    const cut = await overflowing(page);
    check(`the keys of the reference return fit ${cut}`, cut.length === 0);
    await shot(page, "reference");
    await at("home-all").click();
    await eventually("all axes are homed by one line", () => cluster.includes("MDI_LINE G28.2 X0 Y0 Z0 A0 C0"));
    await eventually("in the mode for it", async () => (await shown("mode")) === "MDI");

    await at("estop").click();
    await page.waitForSelector('[data-test="recover"]');
    check("an emergency stop changes the header", (await text(".estop")) === "STOPPED");
    await shot(page, "emergency-stop");
    await at("recover").click();
    await page.waitForSelector('[data-test="estop"]');
  }

  await at("view-parameters").click();
  await at("parameter-search").fill("rapid_feed");
  await page.waitForSelector('[data-parameter="100034"]');
  await page.locator('[data-parameter="100034"]').click();
  await at("parameter-value").fill("-5000000");
  await at("parameter-save").click();
  await page.waitForSelector('[data-test="parameter-refusal"]');
  check("a refused parameter shows the reason", (await text('[data-test="parameter-refusal"]')).length > 10);
  await at("parameter-search").fill("");
  await eventually("all parameters are listed again", () => page.locator("[data-parameter]").count(), (count) => count > 1);
  await settled(page);
  await shot(page, "parameters");
  await at("view-setup").click();
  if (TRUNNION_URL) {
    const table = () => fetch(`${url}api/work-offsets`).then((answer) => answer.json());
    const g55 = (body) => body.offsets.find((offset) => offset.channel === 0 && offset.index === 1)?.values[1] ?? 0;
    const cell = page.getByLabel("G55 Y");
    const value = async () => (await cell.inputValue()).replace("\u2212", "-");
    await cell.click();
    await page.keyboard.type("-123.45678", hand);
    const typed = await cell.inputValue();
    check(`a work offset can be typed at the speed of a hand: ${typed}`, typed === "-123.45678");
    await page.keyboard.press("Enter");
    await eventually("the offset is stored with every digit", async () => g55(await table()) === -123.45678);
    await eventually("and shown rounded", async () => (await value()) === "-123.457");
    const { revision } = await table();
    await cell.click();
    await page.keyboard.press("Tab");
    await settled(page);
    check("a cell that is passed is not stored", (await table()).revision === revision);
    await cell.click();
    await page.keyboard.type("77");
    await page.keyboard.press("Escape");
    await settled(page);
    check("Escape leaves a cell as it was", (await value()) === "-123.457" && g55(await table()) === -123.45678);
    const late = { channel: 0, index: 1, values: [1, 2, 3, 0, 0, 0, 0, 0, 0], revision: revision - 1 };
    const refused = await fetch(`${url}api/work-offsets`, { method: "PUT", body: JSON.stringify(late) });
    check("a change made on old values is refused", refused.status === 409);
  }
  await page.locator(".cell").first().waitFor();
  await settled(page);
  await shot(page, "offsets");
  await at("view-diagnosis").click();
  await page.waitForSelector(".registers, .plc p");
  await settled(page);
  await shot(page, "diagnosis");
  await page.keyboard.press("Alt+1");
  await page.waitForSelector(".positions");
  check("Alt+1 goes back to the operating view", true);
  await page.setViewportSize({ width: 1024, height: 768 });
  await eventually("the page has its new size", () => page.evaluate(() => innerWidth), (width) => width === 1024);
  await settled(page);
  await shot(page, "small");
  const small = await overflowing(page);
  check(`everything fits at 1024x768 ${small}`, small.length === 0);
  check(`the page has no errors ${page.complaints}`, page.complaints.length === 0);

  if (!TRUNNION_URL) {
    // A gateway that hangs keeps its connections open, so only its silence tells. The time is printed, not judged.
    const stopped = Date.now();
    signalGateway("SIGSTOP");
    await page.waitForSelector(".lost h1");
    check(`a lost connection is unmistakable, after ${Date.now() - stopped} ms`, (await text(".lost h1")) === "Connection lost");
    const covered = await coveredStops(page);
    check(`and does not cover the keys that stop ${covered}`, covered.length === 0);
    check("no value keeps its colour", (await coloured(page)).every((filter) => filter === "grayscale(1)"));
    check("nobody says that the cluster is ready", (await text("[data-test=cluster]")) === "Connection lost");
    for (const [width, height] of [[390, 844], [1920, 1080], [1280, 800]]) {
      await page.setViewportSize({ width, height });
      await eventually("the page has its new size", () => page.evaluate(() => innerWidth), (now) => now === width);
      const large = await asLargeAs(page, ".lost h1");
      check(`nothing at ${width}x${height} is as large as the loss ${large}`, large.length === 0);
      const cut = await page.locator(".lost").evaluate((element) => element.scrollWidth > element.clientWidth || element.scrollHeight > element.clientHeight);
      check(`and the loss fits at ${width}x${height}`, !cut);
    }
    await shot(page, "lost");
    const continued = Date.now();
    signalGateway("SIGCONT");
    await eventually("the page is connected again", async () => (await page.locator(".lost").count()) === 0);
    check(`and it heals by itself, after ${Date.now() - continued} ms`, true);
    check("the values have their colour again", (await coloured(page)).every((filter) => filter === "none"));
    signalGateway("SIGKILL");
    await page.waitForSelector(".lost h1");
    check("a gateway that has ended is a lost connection, too", true);
  }
}

await runTest(async (browser, url) => {
  const parts = process.argv.slice(2);
  const wanted = (part) => parts.length === 0 || parts.includes(part);
  if (TRUNNION_URL && wanted("operate")) await operate(browser, url);
  if (TRUNNION_URL && wanted("programs")) await programs(browser, url);
  if (TRUNNION_URL && wanted("setup")) await setup(browser, url);
  if (TRUNNION_URL && wanted("parameters")) await parameters(browser, url);
  if (TRUNNION_URL && wanted("analysis")) await analysis(browser, url);
  if (TRUNNION_URL && wanted("plc")) await plc(browser, url);
  if (TRUNNION_URL && wanted("scene")) await scene(browser, url);
  if (TRUNNION_URL && wanted("appearance")) await appearance(browser, url);
  if (wanted("page")) await run(await openPage(browser, url), url);
});
