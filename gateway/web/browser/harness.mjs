// SPDX-License-Identifier: Apache-2.0
// What the tests of the page share: the cluster, the browser, and what must hold of every view.
import { execFileSync, spawn } from "node:child_process";
import { appendFileSync, cpSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { get } from "node:https";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const { GATEWAY, FAKE_CLUSTER, MACHINE, WEB } = process.env;
/** A cluster that runs already; without it a gateway and a fake cluster are started. */
export const { TRUNNION_URL } = process.env;
export const screenshots = process.env.SCREENSHOTS ?? join(tmpdir(), "trunnion-screenshots");
mkdirSync(screenshots, { recursive: true });
const scratch = mkdtempSync(join(tmpdir(), "trunnion-browser-"));
/** The state directory of the gateway. */
export const state = join(scratch, "state");
const children = [];
/** The requests that have arrived at the fake cluster. */
export let cluster = "";

function start(program, args) {
  const child = spawn(program, args, { stdio: ["ignore", "pipe", "inherit"] });
  children.push(child);
  return child;
}

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** `what` is a text, or a function that says more once it has failed. */
export async function eventually(what, condition, seconds = 10) {
  const until = Date.now() + seconds * 1000;
  for (;;) {
    const result = await condition();
    if (result) return result;
    if (Date.now() > until) throw new Error(`not within ${seconds} s: ${typeof what === "function" ? await what() : what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Whether it comes to be seen; what a page shows may come a moment after what was waited for. */
export const appears = (locator) => locator.waitFor({ timeout: 10000 }).then(() => true, () => false);

/** As a hand does it: over the key, when nothing moves it any more, and down; `page.mouse.up()` lets it go. */
export async function pressDown(page, key) {
  await key.hover();
  await page.mouse.down();
}

export function check(what, condition) {
  if (!condition) throw new Error(`does not hold: ${what}`);
  console.log(`ok   ${what}`);
}

/** Whether `url` answers by TLS, whoever's its certificate is. */
const answersByTls = (url) =>
  new Promise((resolve) => get(url, { rejectUnauthorized: false }, (answer) => resolve(answer.resume().statusCode === 200)).on("error", () => resolve(false)));

/** `settings` are further lines of machine.yaml; `ready` is a path that answers when the gateway does; `tls` makes a certificate. */
export async function startCluster({ settings = "", ready = "api/channels/0", tls = false } = {}) {
  const port = await freePort();
  const machine = join(scratch, "machine");
  cpSync(MACHINE, machine, { recursive: true });
  appendFileSync(join(machine, "machine.yaml"), settings);
  mkdirSync(state);
  if (tls) execFileSync(process.env.TRUNNION, ["certificate", machine, "--state", state]);
  start(FAKE_CLUSTER, ["51"]).stdout.on("data", (text) => (cluster += text));
  const gateway = ["--machine", machine, "--state", state, "--domain", "51", "--web", WEB, "--port", String(port)];
  start(GATEWAY, [...gateway, "--instance", "20"]);
  const url = `${tls ? "https" : "http"}://127.0.0.1:${port}/`;
  const answers = tls ? answersByTls : (target) => fetch(target).then((r) => r.ok, () => false);
  await eventually("the gateway answers", () => answers(`${url}${ready}`));
  return url;
}

export const signalGateway = (signal) => children[1].kill(signal);

export function launch() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
      "--disable-quic",
    ],
  });
}

export function cleanUp() {
  for (const child of children) child.kill("SIGTERM");
  rmSync(scratch, { recursive: true, force: true });
}

/** A page of its own browser profile. Errors that the browser logs are in `complaints`, refusals (400, 409) excepted. */
export async function openPage(browser, url, { size = [1280, 800], locale = "en-GB", colorScheme = "dark", ...more } = {}) {
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, locale, colorScheme, ...more });
  const page = await context.newPage();
  page.complaints = [];
  page.on("pageerror", (error) => page.complaints.push(String(error)));
  page.on("console", (message) => {
    if (message.type() === "error" && !/status of 4(00|09|12)/.test(message.text())) page.complaints.push(message.text());
  });
  if (url) {
    await page.goto(url);
    await page.waitForSelector(".positions");
  }
  return page;
}

export const shot = (page, name) => page.screenshot({ path: join(screenshots, `${name}.png`) });
export const post = (url, path, body = {}) => fetch(`${url}api/${path}`, { method: "POST", body: JSON.stringify(body) });
export const channelState = (url) => fetch(`${url}api/channels/0`).then((answer) => answer.json());

/** Parts of the page whose content is larger than they are, and keys whose text is cut. */
export const overflowing = (page) =>
  page.evaluate(() => {
    const root = document.documentElement;
    const name = (element) => `${element.tagName}.${element.className} "${element.textContent.slice(0, 20)}" ${element.scrollWidth}x${element.scrollHeight} in ${element.clientWidth}x${element.clientHeight}`;
    const large = (element) => element.scrollWidth > element.clientWidth + 1 || element.scrollHeight > element.clientHeight + 1;
    return [...document.querySelectorAll("section, header, nav, .rows, button")]
      .filter((element) => element.offsetParent !== null && !element.matches(".attention, .services, .list"))
      .filter(large)
      .map(name)
      .concat(root.scrollHeight > innerHeight || root.scrollWidth > innerWidth ? ["page"] : []);
  });

/** What can be touched and is smaller than 48 x 48 pixels. */
export const smallTargets = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll("button, select, input, textarea, [role=tab]")]
      .filter((element) => element.offsetParent !== null && element.type !== "file" && element.type !== "range")
      .map((element) => [element, element.getBoundingClientRect()])
      .filter(([, box]) => box.width > 0 && (box.width < 47.5 || box.height < 47.5))
      .map(([element, box]) => `${element.tagName} ${element.getAttribute("aria-label") ?? element.textContent} ${box.width}x${box.height}`),
  );

/** Names of the keys that stop and that something lies over, or that are not on the screen. */
export const coveredStops = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll(".stops button")].flatMap((button) => {
      const { left, right, top, bottom } = button.getBoundingClientRect();
      const points = [[(left + right) / 2, (top + bottom) / 2], [left + 6, top + 6], [right - 6, bottom - 6]];
      const free = points.every(([x, y]) => document.elementFromPoint(x, y)?.closest("button") === button);
      return free ? [] : [button.textContent];
    }),
  );

const axe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

/** Serious and critical findings of axe-core. */
export async function inaccessible(page) {
  if (!(await page.evaluate(() => "axe" in window))) await page.addScriptTag({ path: axe });
  return page.evaluate(async () => {
    const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
    return violations
      .filter(({ impact }) => impact === "serious" || impact === "critical")
      .map(({ id, nodes }) => `${id}: ${nodes.map((node) => `${node.target} (${node.any?.[0]?.message ?? ""})`).slice(0, 4).join("; ")}`);
  });
}

/** Starts the cluster of the test, or takes that of TRUNNION_URL, calls `test(browser, url)` and ends the process. */
export async function runTest(test, settings) {
  let browser;
  let status = 1;
  try {
    const url = TRUNNION_URL ?? (await startCluster(settings));
    browser = await launch();
    await test(browser, url);
    console.log(`screenshots in ${screenshots}`);
    status = 0;
  } catch (error) {
    console.error(error);
    const pages = browser?.contexts().flatMap((context) => context.pages()) ?? [];
    if (pages.length > 0) await shot(pages[pages.length - 1], "failure").catch(() => {});
  } finally {
    await browser?.close();
    cleanUp();
  }
  process.exit(status);
}
