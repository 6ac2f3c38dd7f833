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

/** Seconds. It only ends a hang: no test says that something comes within a time. */
const limit = 60;
const began = Date.now();
/** As a hand types: ms a key. */
export const hand = { delay: 120 };

/**
 * What `read` gives as soon as it `holds`. `what` is a text, or a function that says more once it has failed; the failure
 * has what was read last.
 */
export async function eventually(what, read, holds = Boolean) {
  const until = Date.now() + limit * 1000;
  for (;;) {
    const result = await read();
    if (holds(result)) return result;
    if (Date.now() > until) throw new Error(`not within ${limit} s: ${typeof what === "function" ? await what() : what}; it is ${JSON.stringify(result)}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Whether it comes to be seen; what a page shows may come a moment after what was waited for. */
export const appears = (locator) => locator.waitFor().then(() => true, () => false);

/** The page has drawn two pictures, and has done what waited for them: effects, sizes that were observed. */
export async function drawn(page) {
  let hang;
  const late = new Promise((_, reject) => (hang = setTimeout(() => reject(new Error(`not within ${limit} s: two pictures of ${page.url()} are drawn`)), limit * 1000)));
  const pictures = page.evaluate(async () => {
    for (let i = 0; i < 2; ++i) await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
  });
  await Promise.race([pictures, late]).finally(() => clearTimeout(hang));
}

/** Whatever the page has asked for is answered and drawn, and nothing that it has drawn asks for more. */
export async function settled(page) {
  await eventually(() => `the page has its answers; it waits for ${[...page.asked].map((request) => request.url())}`, async () => {
    const before = page.requests;
    await drawn(page);
    return page.asked.size === 0 && page.requests === before;
  });
}

/** What the stream has told the page of channel 0 `holds`, and is drawn. */
export async function knows(page, what, holds) {
  await eventually(`the page knows that ${what}`, () => page.machine?.channels["0"], (channel) => channel !== undefined && holds(channel));
  await drawn(page);
}

/** `count` further messages of the stream have arrived at the page, and what they change is drawn. */
export async function streamed(page, count) {
  const from = page.messages;
  await eventually(() => `${count} messages of the stream; ${page.messages - from} have come`, () => page.messages >= from + count);
  await drawn(page);
}

/** A notice with `text` that was seen after `act`; it may have gone since, as notices do by themselves. */
export async function told(page, text, act, { refused } = {}) {
  const from = await page.evaluate(() => window.notices.length);
  await act();
  const fits = (notice) => notice.seen && (refused ?? notice.refused) === notice.refused && (text instanceof RegExp ? text.test(notice.text) : notice.text.includes(text));
  const notices = await eventually(`the page tells ${text}`, () => page.evaluate((first) => window.notices.slice(first), from), (list) => list.some(fits));
  return notices.find(fits).text;
}

/** Runs in the page: keeps the notices that it has shown. */
function keepNotices() {
  window.notices = [];
  let last;
  new MutationObserver(() => {
    const element = document.querySelector(".notice");
    const now = element?.className + element?.textContent;
    if (element && now !== last) window.notices.push({ text: element.innerText, refused: element.classList.contains("refused"), seen: element.getClientRects().length > 0 });
    last = now;
  }).observe(document, { subtree: true, childList: true, characterData: true, attributes: true });
}

/** As a hand does it: over the key, when nothing moves it any more, and down; `page.mouse.up()` lets it go. */
export async function pressDown(page, key) {
  await key.hover();
  await page.mouse.down();
}

export function check(what, condition) {
  if (!condition) throw new Error(`does not hold: ${what}`);
  console.log(`ok   ${((Date.now() - began) / 1000).toFixed(1).padStart(6)} s  ${what}`);
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

/** As gateway/web/src/state/patch.ts. */
function patched(target, patch) {
  if (typeof patch !== "object" || patch === null || Array.isArray(patch)) return patch;
  const merged = typeof target === "object" && target !== null && !Array.isArray(target) ? { ...target } : {};
  for (const [name, value] of Object.entries(patch)) {
    if (value === null) delete merged[name];
    else merged[name] = patched(merged[name], value);
  }
  return merged;
}

/** Of the stream: the state in `machine`, the `messages` that have arrived, the `orders` that were sent, the `refusals` of a connection. */
function followStream(page) {
  Object.assign(page, { machine: undefined, messages: 0, orders: [], refusals: 0 });
  page.on("websocket", (socket) => {
    if (!socket.url().endsWith("/api/stream")) return;
    socket.on("socketerror", () => ++page.refusals);
    socket.on("framesent", ({ payload }) => page.orders.push(JSON.parse(payload).path));
    socket.on("framereceived", ({ payload }) => {
      const message = JSON.parse(payload);
      if ("answer" in message) return;
      page.machine = "state" in message ? message.state : patched(page.machine, message.changes);
      ++page.messages;
    });
  });
}

/** Of the page: what it has `asked` for and has no answer to yet, and how many `requests` there were. */
function followRequests(page) {
  Object.assign(page, { asked: new Set(), requests: 0 });
  page.on("request", (request) => {
    // The page before has nothing to wait for any more.
    if (request.isNavigationRequest() && request.frame() === page.mainFrame()) page.asked.clear();
    page.asked.add(request);
    ++page.requests;
  });
  for (const end of ["requestfinished", "requestfailed"]) page.on(end, (request) => page.asked.delete(request));
}

/** A page of its own browser profile. Errors that the browser logs are in `complaints`, refusals (400, 409) excepted. */
export async function openPage(browser, url, { size = [1280, 800], locale = "en-GB", colorScheme = "dark", ...more } = {}) {
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, locale, colorScheme, ...more });
  context.setDefaultTimeout(limit * 1000);
  const page = await context.newPage();
  page.complaints = [];
  page.on("pageerror", (error) => page.complaints.push(String(error)));
  page.on("console", (message) => {
    const url = message.location().url;
    // The program of a command is shown while it runs, and may be gone before the page has read it.
    const gone = /status of 404/.test(message.text()) && /\/api\/programs\/[^/]*\.tmp\.nc/.test(url);
    if (message.type() === "error" && !gone && !/status of 4(00|09|12)/.test(message.text())) page.complaints.push(`${message.text()} ${url}`);
  });
  await page.addInitScript(keepNotices);
  followStream(page);
  followRequests(page);
  if (url) {
    await page.goto(url);
    await page.waitForSelector(".positions");
  }
  return page;
}

export const shot = (page, name) => page.screenshot({ path: join(screenshots, `${name}.png`) });
export const post = (url, path, body = {}) => fetch(`${url}api/${path}`, { method: "POST", body: JSON.stringify(body) });
export const channelState = (url) => fetch(`${url}api/channels/0`).then((answer) => answer.json());

/** A line of MDI to its end: the channel is idle, and the axes are where `machine` and `workpiece` say, by letters, in mm and deg. */
export async function mdi(url, line, { machine = {}, workpiece = {} } = {}) {
  await eventually(`${line} is accepted`, async () => (await post(url, "channels/0/mdi", { line })).ok);
  const near = (position, wanted) => wanted === undefined || Math.abs(position - wanted) < 1e-3;  // a drive settles
  await eventually(`${line} is executed`, () => channelState(url), ({ state, positions }) =>
    state === "IDLE" && positions.every((one) => near(one.machine, machine[one.letter]) && near(one.workpiece, workpiece[one.letter])));
}

/** Parts of the page whose content is larger than they are, and keys whose text is cut. */
export const overflowing = (page) =>
  page.evaluate(() => {
    const root = document.documentElement;
    const name = (element) => `${element.tagName}.${element.className} "${element.textContent.slice(0, 20)}" ${element.scrollWidth}x${element.scrollHeight} in ${element.clientWidth}x${element.clientHeight}`;
    const large = (element) => element.scrollWidth > element.clientWidth + 1 || element.scrollHeight > element.clientHeight + 1;
    return [...document.querySelectorAll("section, header, .facts, nav, .rows, button")]
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

/** Where the keys that stop are. */
export const stopPlaces = (page) =>
  page.evaluate(() => [...document.querySelectorAll(".stops button")].map((key) => key.getBoundingClientRect()).map(({ x, y, width, height }) => [x, y, width, height].map(Math.round).join()).join(" "));

/** Before the page is opened: passes its stream on. Gives the connection it has, into which messages can be put. */
export async function interceptStream(page) {
  let current;
  await page.routeWebSocket(/api\/stream/, (socket) => {
    const server = socket.connectToServer();
    const own = (current = { sequence: 0, send: (message) => socket.send(JSON.stringify(message)) });
    socket.onMessage((message) => server.send(message));
    server.onMessage((text) => {
      own.sequence = JSON.parse(text).sequence ?? own.sequence;
      socket.send(text);
    });
  });
  return () => current;
}

/** What the page is told besides, by a merge patch: parts of the state in `changes`. */
export function pretend(stream, changes) {
  const { sequence, send } = stream();
  send({ sequence, since: sequence, changes });
}

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

const shownBy = async (page) => `${page.url()}: ${(await page.locator("body").innerText({ timeout: 5000 })).replaceAll(/\s+/g, " ").slice(0, 3000)}`;

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
    for (const page of pages) console.error(`shown: ${await shownBy(page).catch(() => "the page does not answer")}`);
    if (pages.length > 0) await shot(pages[pages.length - 1], "failure").catch(() => {});
  } finally {
    await browser?.close();
    cleanUp();
  }
  process.exit(status);
}
