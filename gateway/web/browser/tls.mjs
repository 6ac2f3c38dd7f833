// SPDX-License-Identifier: Apache-2.0
// A machine that is reached by TLS only, in a real browser: login with a cookie that travels encrypted, the stream, a stop.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { check, cluster, eventually, openPage, pressDown, runTest, state } from "./harness.mjs";

await runTest(async (browser, url) => {
  const page = await openPage(browser, null, { ignoreHTTPSErrors: true });
  await page.goto(url.replace("https:", "http:"));
  check("an address without https leads to the one with it", page.url() === url);
  const form = page.getByRole("form", { name: "Log in" });
  await form.getByLabel("User").fill("admin");
  await form.getByLabel("Password").fill(readFileSync(join(state, "initial-password"), "utf8").trim());
  await form.getByRole("button", { name: "Log in" }).click();
  await page.locator(".positions").waitFor();
  check("the stream comes by TLS", (await page.locator(".positions").textContent()).length > 0);
  const [cookie] = (await page.context().cookies()).filter(({ name }) => name === "trunnion_session");
  check("the cookie of the session is sent encrypted only", cookie.secure && cookie.httpOnly);
  await pressDown(page, page.getByRole("button", { name: "Feed hold" }));
  await eventually("the hold arrives", () => cluster.includes("FEED_HOLD"));
  await page.mouse.up();
  check("a hold arrives on press", true);
  check(`nothing is complained of ${page.complaints}`, page.complaints.filter((text) => !/401|WebSocket/.test(text)).length === 0);
}, { settings: "auth: on\ntls: on\n", ready: "api/openapi.json", tls: true });
