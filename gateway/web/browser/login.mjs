// SPDX-License-Identifier: Apache-2.0
// A machine whose users log in, in a real browser: first start, wrong password, roles, time-out of the session, logout.
// The keys that stop work throughout. By roles and names, in English and Chinese.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { appears, check, cluster, coveredStops, eventually, hand, inaccessible, openPage, pressDown, runTest, settled, shot, state } from "./harness.mjs";

const idle = 12;  // s, as in the settings below
const english = {
  locale: "en-GB", title: "Log in", user: "User", password: "Password", key: "Log in", logout: "Log out", wrong: "wrong name or password",
  over: "The session is over. Log in again.", stop: "Emergency stop", hold: "Feed hold", start: "Cycle start", parameters: "Parameters",
  setup: "Setup", operate: "Operate", find: "Number, name or help", value: /^Value/, store: "Store", undo: "Undo",
  operator: "This needs the role setter; ann is operator.", builder: "This needs the role machine builder; sam is setter.",
};
const chinese = {
  locale: "zh-CN", title: "登录", user: "用户", password: "密码", key: "登录", logout: "退出登录", over: "会话已结束，请重新登录。",
  stop: "急停", hold: "进给保持", setup: "调整", operate: "操作", operator: "此操作需要调整员权限；ann 的权限是操作员。",
};

function addUser(name, role) {
  execFileSync(process.env.TRUNNION, ["user", "add", name, "--role", role, "--state", state], { input: `password of ${name}\n` });
}

const go = (page, view) => page.getByRole("navigation").getByRole("button", { name: view, exact: true }).click();

async function logIn(page, words, name, password, type = { delay: 0 }) {
  const form = page.getByRole("form", { name: words.title });
  await form.waitFor();
  await form.getByLabel(words.user).click();
  await page.keyboard.press("Control+a");
  await page.keyboard.type(name, type);
  await form.getByLabel(words.password).click();
  await page.keyboard.type(password, type);
  await form.getByRole("button", { name: words.key }).click();
}

async function logOut(page, words, name) {
  await page.getByRole("button", { name: `${words.logout} ${name}` }).click();
  await page.getByRole("form", { name: words.title }).waitFor();
}

/** Stops the machine as a hand does: on press. */
async function press(page, name) {
  await pressDown(page, page.getByRole("button", { name }));
  await page.mouse.up();
}

async function visitor(page, url, words) {
  await page.goto(url);
  const form = page.getByRole("form", { name: words.title });
  await form.waitFor();
  await eventually("the stream is refused", () => page.refusals, (refusals) => refusals >= 1);
  await settled(page);
  check("without a login there are no positions", (await page.locator(".positions").count()) === 0);
  const covered = await coveredStops(page);
  check(`and the keys that stop are free ${covered}`, covered.length === 0);
  const held = page.waitForResponse((answer) => answer.url().endsWith("/feed-hold"));
  await press(page, words.hold);
  check("feed hold works without a login", (await held).status() === 200);
  const stopped = page.waitForResponse((answer) => answer.url().endsWith("/emergency-stop"));
  await press(page, words.stop);
  check("the emergency stop works without a login", (await stopped).status() === 200);
  const findings = await inaccessible(page);
  check(`the login has names ${findings}`, findings.length === 0);
  await shot(page, "login");
}

async function first(page, words) {
  await logIn(page, words, "admin", "guessed", hand);
  await page.getByRole("alert").filter({ hasText: words.wrong }).waitFor();
  check("a wrong password is refused and the form stays", (await page.getByLabel(words.password).inputValue()) === "");
  await logIn(page, words, "admin", readFileSync(join(state, "initial-password"), "utf8").trim());
  await page.locator(".positions").waitFor();
  check("the administrator of the first start logs in", await appears(page.getByRole("button", { name: `${words.logout} admin` })));
  await logOut(page, words, "admin");
  check("and logs out", (await page.locator(".positions").count()) === 0);
}

async function operator(page, words) {
  await logIn(page, words, "ann", "password of ann");
  await page.locator(".positions").waitFor();
  await page.getByRole("button", { name: "Auto", exact: true }).click();
  // It was stopped without a login: recovery leads back.
  await page.getByRole("button", { name: "Recover" }).click();
  await page.locator("[data-test=estop]").waitFor();
  await page.getByRole("button", { name: words.start }).click();
  await eventually("the order of an operator arrives", () => cluster.includes("CYCLE_START"));
  check("an operator starts a program", true);
  await go(page, words.parameters);
  await page.getByRole("searchbox", { name: words.find }).fill("000011");
  await page.locator('[data-parameter="000011"]').click();
  await page.getByLabel(words.value).waitFor();
  check("a parameter is dark for an operator", (await page.getByLabel(words.value).isDisabled()) && (await page.getByRole("button", { name: words.store }).isDisabled()));
  check("and says why", (await page.getByText(words.operator).count()) >= 1);
  await shot(page, "login-operator");
  await go(page, words.setup);
  await page.getByLabel("G54 X").waitFor();
  check("so is a work offset", (await page.getByLabel("G54 X").isDisabled()) && (await appears(page.getByRole("note").filter({ hasText: words.operator }))));
  check("and its undo", await page.getByRole("button", { name: words.undo }).isDisabled());
  await page.getByRole("tab", { name: "Kinematics" }).click();
  const measurement = page.getByRole("region", { name: "Measurement" });
  await measurement.getByText("1 of 1 poses are complete").waitFor();
  for (const name of ["Start measurement", "Write result", "Discard"])
    check(`a measurement is the setter's and the builder's: ${name} is dark`, await measurement.getByRole("button", { name }).isDisabled());
  await page.getByRole("table", { name: "Poses" }).waitFor();
  check("and its result is everybody's", true);
  const findings = await inaccessible(page);
  check(`what is dark has names ${findings}`, findings.length === 0);
  await logOut(page, words, "ann");
}

async function setter(page, words) {
  await logIn(page, words, "sam", "password of sam");
  await page.locator(".positions").waitFor();
  await go(page, words.parameters);
  const field = page.getByLabel(words.value);
  await page.getByRole("searchbox", { name: words.find }).fill("000011");
  await page.locator('[data-parameter="000011"]').click();
  await field.waitFor();
  check("a setter may change a parameter of access user", await field.isEnabled());
  await page.getByRole("searchbox", { name: words.find }).fill("000010");
  await page.locator('[data-parameter="000010"]').click();
  await page.getByText(words.builder).waitFor();
  check("one of the machine builder is dark and says why", await field.isDisabled());
  await go(page, words.setup);
  await page.getByRole("tab", { name: "Kinematics" }).click();
  const measurement = page.getByRole("region", { name: "Measurement" });
  await measurement.getByRole("note").filter({ hasText: words.builder }).waitFor();
  check("a setter discards a result", await measurement.getByRole("button", { name: "Discard" }).isEnabled());
  check("and who may write it is said", await measurement.getByRole("button", { name: "Write result" }).isDisabled());
}

/** Works in the session until the function is called that it gives: what the test looks at meanwhile may take longer than `idle`. */
function work(page, url) {
  let ends = false;
  const done = (async () => {
    while (!ends) {
      await page.context().request.get(`${url}api/work-offsets`).catch(() => undefined);
      await new Promise((resolve) => setTimeout(resolve, 1000));
    }
  })();
  return () => {
    ends = true;
    return done;
  };
}

/** `finish` ends the work in the session: what the page has asked for before is answered within it. */
async function timeOut(page, url, words, finish) {
  await settled(page);
  await finish();
  const now = () => performance.now() / 1000;
  const { request } = page.context();
  const asked = now();
  await request.get(`${url}api/work-offsets`);
  const answered = now();
  // The page goes on asking for the state, and the test for the session, which is nobody's doing. Of the session's own time the
  // gateway has seen at least that from the answer to a question, and at most that from the question to an answer.
  const looks = [];
  await eventually("the session is over", async () => {
    const least = now() - answered;
    const { name } = await (await request.get(`${url}api/session`)).json();
    looks.push({ name, least, most: now() - asked });
    return name;
  }, (name) => name === "");
  const right = looks.every(({ name, least, most }) => (name === "" ? most >= idle : least <= idle));
  check(`a session ends ${idle} s after its last request: ${JSON.stringify(looks.slice(-2))}`, right);
  await page.getByRole("form", { name: words.title }).waitFor();
  check("and the page says so", await appears(page.getByText(words.over)));
  const covered = await coveredStops(page);
  check(`the keys that stop stay free ${covered}`, covered.length === 0);
}

async function inChinese(browser, url) {
  const words = chinese;
  const page = await openPage(browser, undefined, { locale: words.locale });
  await page.goto(url);
  const finish = work(page, url);
  await logIn(page, words, "ann", "password of ann");
  await page.locator(".positions").waitFor();
  await go(page, words.setup);
  await page.getByRole("note").filter({ hasText: words.operator }).waitFor();
  check("Chinese: an operator reads why a work offset is dark", await page.getByLabel("G54 X").isDisabled());
  await shot(page, "login-chinese");
  await timeOut(page, url, words, finish);
  await logIn(page, words, "ann", "password of ann");
  await page.getByRole("button", { name: `${words.logout} ann` }).waitFor();
  await logOut(page, words, "ann");
  check("Chinese: log in again and out", true);
  await page.context().close();
}

await runTest(async (browser, url) => {
  addUser("ann", "operator");
  addUser("sam", "setter");
  const page = await openPage(browser, undefined);
  await visitor(page, url, english);
  const finish = work(page, url);
  await first(page, english);
  await operator(page, english);
  await setter(page, english);
  await timeOut(page, url, english, finish);
  // A browser logs every refused request: those before the login and after the end of a session.
  const others = page.complaints.filter((text) => !/401|WebSocket/.test(text));
  check(`the page has no errors ${others}`, others.length === 0);
  await inChinese(browser, url);
}, { settings: `auth: on\nsession_idle_minutes: ${idle / 60}\n`, ready: "api/openapi.json" });
