// SPDX-License-Identifier: Apache-2.0
// Programs: typed at the speed of a hand, checked while they are typed, kept over a reload, saved with their revision.
import { readFile } from "node:fs/promises";
import { appears, channelState, check, eventually, hand, openPage, overflowing, settled, shot, streamed, told } from "./harness.mjs";

const stored = async (url, name) => fetch(`${url}api/programs/${name}`).then(async (answer) => ({ status: answer.status, tag: answer.headers.get("etag"), text: await answer.text() }));
const put = (url, name, body, headers = {}) => fetch(`${url}api/programs/${name}`, { method: "PUT", body, headers });

async function interfaces(url) {
  await fetch(`${url}api/programs/page-if.nc`, { method: "DELETE" });
  const created = await put(url, "page-if.nc", "G0 X1\n", { "If-None-Match": "*" });
  const { program } = await created.json();
  check("a new program is stored where none is", created.status === 200 && program.name === "page-if.nc");
  const again = await put(url, "page-if.nc", "G0 X9\n", { "If-None-Match": "*" });
  check("and refused where there is one, at once", again.status === 412 && (await stored(url, "page-if.nc")).text === "G0 X1\n");
  check("the entity tag is the revision", (await stored(url, "page-if.nc")).tag === `"${program.revision}"`);
  check("a change of an old revision is refused", (await put(url, "page-if.nc", "G0 X2\n", { "If-Match": `"${program.revision + 1}"` })).status === 412);
  check("a change of the newest one is stored", (await put(url, "page-if.nc", "G0 X2\n", { "If-Match": `"${program.revision}"` })).status === 200);
  await fetch(`${url}api/programs/page-if.nc`, { method: "DELETE" });
}

async function typing(page, url) {
  const list = page.getByRole("region", { name: "Stored programs" }).first();
  const editor = page.getByRole("textbox", { name: "Text of page-a.nc" });
  await list.getByRole("button", { name: "New…" }).click();
  await page.getByRole("textbox", { name: "Name of the new program" }).pressSequentially("page a.nc", hand);
  await page.getByRole("alert").filter({ hasText: "1 to 64 letters" }).waitFor();
  check("a name that no program can have is named at once", true);
  await page.getByRole("textbox", { name: "Name of the new program" }).fill("page-a.nc");
  await page.getByRole("button", { name: "Create" }).click();
  await editor.click();
  await page.keyboard.type("G54 G0 X1\nG1 X2 Q4 F100\nT1 M6 (mill)", hand);
  const error = page.getByRole("button", { name: /Line 2, column 7/ });
  await error.waitFor();
  check("the error is named with line, column and alarm while one types", /1107/.test(await error.innerText()));
  check("and marked in the text", (await page.locator(".cm-lintRange-error").innerText()) === "Q4");
  check("codes are coloured", (await page.locator(".nc-code").allInnerTexts()).includes("G54"));
  check("the outline shows the tool change", await appears(page.getByRole("button", { name: /T1 M6/ })));
  await error.click();
  await page.keyboard.press("End");
  for (let i = 0; i < 7; ++i) await page.keyboard.press("Backspace");
  await page.keyboard.type("F100", hand);
  await page.getByText(/No error: \d+ blocks/).waitFor();
  check("and is gone when it is corrected", (await page.locator(".cm-lintRange-error").count()) === 0);

  await page.reload();
  await page.getByRole("navigation", { name: "Views" }).getByRole("button", { name: "Programs", exact: true }).click();
  await list.getByRole("button", { name: /page-a.nc/ }).click();
  const lines = async () => (await page.locator(".cm-line").allInnerTexts()).join("\n");
  await eventually("the text is there", async () => (await lines()).includes("G1 X2 F100"));
  check("text that is not saved is there after a reload, and said to be not saved", await appears(page.locator("[data-test=not-saved]")));
  check("nothing was stored meanwhile", (await stored(url, "page-a.nc")).status === 404);

  await page.route("**/api/programs/page-a.nc", (route) => (route.request().method() === "PUT" ? route.abort() : route.continue()));
  await told(page, "no connection", () => page.getByRole("button", { name: "Save", exact: true }).click());
  check("without a connection saving says so and the text stays", (await lines()).includes("G1 X2 F100"));
  page.complaints.length = 0;
  await page.unroute("**/api/programs/page-a.nc");
  await page.keyboard.press("Control+s");
  await eventually("it is stored", async () => (await stored(url, "page-a.nc")).text === "G54 G0 X1\nG1 X2 F100\nT1 M6 (mill)");
  await page.locator("[data-test=not-saved]").waitFor({ state: "detached" });
  check("Ctrl+S stores it", true);
}

async function conflicts(page, url) {
  const { tag } = await stored(url, "page-a.nc");
  await eventually("another station stores a text", async () => (await put(url, "page-a.nc", "(other)\nG0 X5\n", { "If-Match": tag })).status === 200);
  await page.getByText(/revision \d+ is stored by now/).waitFor();
  check("a newer revision is shown", true);
  const editor = page.getByRole("textbox", { name: "Text of page-a.nc" });
  await editor.click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("\nM30", hand);
  await eventually("the change is known", () => page.getByRole("button", { name: "Save", exact: true }).isEnabled());
  await page.getByRole("button", { name: "Save", exact: true }).click();
  const question = page.getByRole("alertdialog", { name: /page-a.nc was changed by someone else/ });
  await question.waitFor();
  check("a text made on an old revision is asked about, not stored", (await stored(url, "page-a.nc")).text.startsWith("(other)"));
  await page.getByRole("combobox", { name: "Compare with…" }).selectOption({ label: "the stored text" });
  await page.getByText(/Compared with page-a.nc, revision \d+: [1-9]\d* places? differ/).waitFor();
  await page.getByRole("button", { name: "next difference" }).click();
  check("the two texts can be compared before the answer", (await page.locator(".cm-deletedChunk").count()) > 0);
  await shot(page, "programs-compare");
  await page.getByRole("button", { name: "End", exact: true }).click();
  await question.getByRole("button", { name: "Replace" }).click();
  await eventually("it is replaced", async () => (await stored(url, "page-a.nc")).text.endsWith("M30"));
  check("and replaced when that is answered", true);
  await page.setInputFiles("input[type=file][aria-label='a file…']", { name: "other.nc", mimeType: "text/plain", buffer: Buffer.from("G54 G0 X1\nG1 X2 F100\nT2 M6\nM30") });
  await page.getByText("Compared with other.nc: 1 place differs").waitFor();
  check("a file can be compared", true);
  await page.getByRole("button", { name: "End", exact: true }).click();
}

async function files(page, url) {
  const before = await channelState(url);
  await page.getByRole("textbox", { name: "Text of page-a.nc" }).click();
  await page.keyboard.press("Control+f");
  const field = page.getByRole("textbox", { name: "Find" });
  await field.pressSequentially("M6", hand);
  await page.keyboard.press("Escape");
  await field.waitFor({ state: "detached" });
  await settled(page);
  check("Escape closes the search of the editor and holds nothing", page.orders.length === 0 && (await channelState(url)).state === before.state);

  const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Download" }).click()]);
  check("a download is the text", (await readFile(await saved.path(), "utf8")) === (await stored(url, "page-a.nc")).text);
  await page.getByRole("button", { name: "Rename…" }).click();
  await page.getByRole("textbox", { name: "New name of page-a.nc" }).fill("page-b.nc");
  await page.getByRole("button", { name: "Rename", exact: true }).click();
  await page.getByRole("textbox", { name: "Text of page-b.nc" }).waitFor();
  check("a program is renamed", (await stored(url, "page-a.nc")).status === 404 && (await stored(url, "page-b.nc")).status === 200);
  await put(url, "page-c.nc", "G0 X1\n");
  await page.getByRole("group").filter({ hasText: /^page/ }).first().waitFor();
  check("programs whose names begin alike are a folder", true);
  await page.getByRole("button", { name: "Delete", exact: true }).click();
  await page.getByRole("alertdialog", { name: "Delete page-b.nc?" }).getByRole("button", { name: "Delete" }).click();
  await eventually("it is deleted", async () => (await stored(url, "page-b.nc")).status === 404);
  await fetch(`${url}api/programs/page-c.nc`, { method: "DELETE" });
  check("a program is deleted after a question", true);
}

async function path(page) {
  await page.getByRole("searchbox", { name: "Find a program" }).pressSequentially("cone", hand);
  const list = page.getByRole("region", { name: "Stored programs" }).first();
  await eventually("one is left", async () => (await list.locator(".choose").count()) === 1);
  await list.getByRole("button", { name: /nas979_cone.nc/ }).click();
  await page.getByText(/No error: \d+ blocks/).waitFor();
  await page.getByRole("button", { name: /T1 M6/ }).waitFor();
  await page.getByRole("tab", { name: "Path" }).click();
  const preview = page.getByRole("img", { name: /Path of the checked program/ });
  check("the path of the program is beside its text", Number(await preview.getAttribute("data-points")) > 800);
  await page.getByRole("textbox", { name: "Text of nas979_cone.nc" }).click();
  await page.keyboard.press("Control+Home");
  for (let i = 0; i < 14; ++i) await page.keyboard.press("ArrowDown");
  await eventually("the line of the cursor is marked", async () => Number(await preview.getAttribute("data-marked")) > 0);
  check("the line of the cursor is marked on the path", true);
  await page.mouse.move(640, 500);
  const cut = await overflowing(page);
  check(`everything fits ${cut}`, cut.length === 0);
  await shot(page, "programs");
}

export async function programs(browser, url) {
  await interfaces(url);
  for (const name of ["page-a.nc", "page-b.nc", "page-c.nc"]) await fetch(`${url}api/programs/${name}`, { method: "DELETE" });
  const page = await openPage(browser, null, { acceptDownloads: true });
  const requested = [];
  page.on("request", (request) => requested.push(request.url()));
  await page.goto(url);
  await page.waitForSelector(".positions");
  await streamed(page, 5);
  await settled(page);
  check("the editor is not loaded with the first view", !requested.some((one) => /editor|Programs/.test(one)));
  await page.getByRole("navigation", { name: "Views" }).getByRole("button", { name: "Programs", exact: true }).click();
  await typing(page, url);
  await conflicts(page, url);
  await files(page, url);
  await path(page);
  check(`programs log no errors ${page.complaints}`, page.complaints.length === 0);
  await page.context().close();
}
