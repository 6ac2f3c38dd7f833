// SPDX-License-Identifier: Apache-2.0
// Operating a real cluster by roles and names: MDI of several lines, alarms with cause and remedy in every view, and the
// keys that stop.
import { channelState, check, coveredStops, eventually, hand, mdi, openPage, post, pressDown, settled, shot, told } from "./harness.mjs";

const views = ["Operate", "3D", "Programs", "Setup", "Parameters", "Analysis", "Diagnosis"];
const machineX = async (url) => (await channelState(url)).machine[0];
const close = (a, b) => Math.abs(a - b) < 0.01;

async function mdiLines(page, url) {
  const field = page.getByRole("textbox", { name: "MDI lines" });
  await field.click();
  await page.keyboard.type("G54 G0 X11\nG1 X12 F3000\nG4 P100\nG0 X13.25", hand);
  check("MDI lines can be typed at the speed of a hand", (await field.inputValue()) === "G54 G0 X11\nG1 X12 F3000\nG4 P100\nG0 X13.25");
  await page.getByRole("button", { name: "Execute" }).click();
  await eventually("the last of several MDI lines is executed", () => machineX(url), (x) => close(x, 13.25));
  await eventually("the field is empty again", async () => (await field.inputValue()) === "");
  check("several MDI lines are executed one after the other", true);

  await field.fill("#100=1.5\n#512=-[2/3]");
  await page.getByRole("button", { name: "Execute" }).click();
  await page.getByRole("tab", { name: "Variables" }).click();
  const variables = page.getByRole("region", { name: "Variables" });
  await variables.getByRole("row", { name: "#100 1.5" }).waitFor();
  await page.getByRole("searchbox", { name: "Number of a variable" }).pressSequentially("512", hand);
  await variables.getByRole("row", { name: "#512 -0.666666" }).waitFor();
  check("macro variables are shown and found by their number", (await variables.getByRole("row", { name: "#100 1.5" }).count()) === 0);
  await shot(page, "variables");
  await page.getByRole("searchbox", { name: "Number of a variable" }).fill("");
  await page.getByRole("tab", { name: "Tool path" }).click();
  const load = page.getByRole("meter", { name: /^Load of X/ });
  const percent = Number(await load.getAttribute("aria-valuenow"));
  check(`an axis shows its load: ${percent} %`, percent >= 0 && percent <= 100 && (await page.getByRole("meter").count()) === (await channelState(url)).axes.length);

  const sent = [];
  page.on("request", (request) => request.url().endsWith("/mdi") && sent.push(request.postDataJSON().line));
  await field.fill("G0 X14\n?? X15\nG0 X16");
  await told(page, "line 2 of 3", () => page.getByRole("button", { name: "Execute" }).click());
  // Whatever the page has sent is answered, and the channel executes a line that comes after it.
  await settled(page);
  await mdi(url, "G4 P100");
  check(`a bad line ends the rest: ${sent}`, close(await machineX(url), 14) && !sent.includes("G0 X16"));
  check("and the lines stay to be corrected", (await field.inputValue()).includes("?? X15"));
  await post(url, "alarms/reset");

  await page.reload();
  const history = page.getByRole("combobox", { name: "Earlier MDI lines" });
  await history.selectOption({ label: "G54 G0 X11 / G1 X12 F3000 / G4 P100 / G0 X13.25" });
  check("earlier MDI lines are kept over a reload", (await field.inputValue()).startsWith("G54 G0 X11\nG1 X12"));
  await field.fill("");
}

async function alarmsAndStops(page, url) {
  const stop = page.getByRole("button", { name: "Emergency stop" });
  const hold = page.getByRole("button", { name: "Feed hold" });
  check("stop and hold are free before anything happened", (await coveredStops(page)).length === 0);

  // On press: the pointer goes down and does not come up again before the order has acted.
  await pressDown(page, stop);
  await page.locator("[data-test=estop-engaged]").waitFor();
  check("the emergency stop acts on press", true);
  await page.mouse.up();

  const alarms = page.getByRole("region", { name: "Alarms", exact: true }).first();
  await alarms.filter({ hasText: "130" }).waitFor();
  for (const view of views) {
    await page.getByRole("navigation", { name: "Views" }).getByRole("button", { name: view, exact: true }).click();
    const text = await alarms.innerText();
    check(`${view}: the strip has count, text, cause and remedy`, /\d+ alarms?/.test(text) && /130/.test(text) && /Cause: /.test(text) && /Remedy: /.test(text));
    await alarms.getByRole("button", { name: /alarm/ }).first().click();
    check(`${view}: the list of alarms covers no key that stops`, (await coveredStops(page)).length === 0);
    if (view === "Operate") await shot(page, "alarms");
    await alarms.getByRole("button", { name: /alarm/ }).first().click();
  }
  await page.getByRole("button", { name: "Operate", exact: true }).click();
  await page.getByRole("button", { name: "Recover" }).click();
  await page.locator("[data-test=estop]").waitFor();
  await eventually("the alarms are gone", async () => /No alarms/.test(await alarms.innerText()));
  await page.getByRole("button", { name: "Diagnosis", exact: true }).click();
  await page.getByRole("button", { name: "History", exact: true }).click();
  const past = page.locator("[data-test=alarm-history] li");
  await page.getByRole("searchbox", { name: "Number, text or source" }).fill("130");
  await eventually("the history has the emergency stop", async () => /^130\s.*\s\d{4}-\d\d-\d\d \d\d:\d\d:\d\d · lasted 0:\d\d:\d\d · plc/s.test(await past.first().innerText()));
  check(`the history has when the alarm was raised and how long it lasted: ${(await past.first().innerText()).replaceAll(/\s+/g, " ")}`, true);
  await shot(page, "alarm-history");
  await page.getByRole("searchbox", { name: "Number, text or source" }).fill("");
  await page.getByRole("button", { name: "Operate", exact: true }).click();
  check("recovery leads back", true);

  // A question does not cover them either, and the machine can be held while it waits.
  await page.getByRole("button", { name: "Upload…" }).waitFor();
  const upload = (content) =>
    page.setInputFiles("input[type=file]", { name: "page_test.nc", mimeType: "text/plain", buffer: Buffer.from(content) });
  await fetch(`${url}api/programs/page_test.nc`, { method: "PUT", body: "G0 X0\nM30\n" });
  const listed = () => fetch(`${url}api/programs`).then((answer) => answer.json());
  await eventually("the program is listed", async () => (await listed()).programs.some((one) => one.name === "page_test.nc"));
  await upload("G1 X100 F1\nG1 X-100\nM30\n");
  const question = page.getByRole("alertdialog", { name: /page_test.nc is stored already/ });
  await question.waitFor();
  check("a question covers no key that stops", (await coveredStops(page)).length === 0);
  await question.getByRole("button", { name: "Replace" }).click();
  await eventually("the program is replaced", async () => (await (await fetch(`${url}api/programs/page_test.nc`)).text()).includes("F1"));
  await page.getByRole("button", { name: "Select…" }).click();
  await page.getByRole("button", { name: /^page_test.nc/ }).click();
  await page.getByRole("button", { name: "Auto", exact: true }).click();
  await eventually("automatic mode", async () => (await channelState(url)).mode === "AUTO");
  // A cluster in virtual time passes an hour in 20 s: the line is to last for days.
  await post(url, "channels/0/override", { kind: "feed", value: 0.01 });
  await page.getByRole("button", { name: "Cycle start" }).click();
  await eventually("the program runs", async () => (await channelState(url)).state === "RUNNING");
  await eventually("the running time counts", async () => /\d:\d\d:\d\d/.test(await page.locator("[data-test=elapsed]").innerText()));
  const elapsed = async () => (await page.locator("[data-test=elapsed]").innerText()).split(":").reduce((sum, part) => 60 * sum + Number(part), 0);
  const before = await eventually("a second has passed", elapsed, (seconds) => seconds >= 1);
  await page.reload();
  const after = await elapsed();
  check(`a page that is opened anew has the time of the whole run: ${before} s, then ${after} s`, after >= before);
  await eventually("distance to go is shown", async () => (await page.locator("[data-test=to-go-X]").innerText()) !== "0.000");
  await page.getByRole("button", { name: "Parameters", exact: true }).click();
  await page.locator("[data-test=view-parameters][aria-current=page]").waitFor();
  await pressDown(page, hold);
  await eventually("feed hold in another view holds on press", async () => (await channelState(url)).state === "HELD");
  await page.mouse.up();
  check("feed hold acts on press in every view", true);
  await page.getByRole("button", { name: "Operate", exact: true }).click();
  await page.getByRole("button", { name: "Reset", exact: true }).click();
  await eventually("reset", async () => (await channelState(url)).state === "IDLE");

  await page.getByRole("button", { name: "Cycle start" }).click();
  await eventually("the program runs again", async () => (await channelState(url)).state === "RUNNING" && (await channelState(url)).line === 1);
  await pressDown(page, page.locator("[data-test=estop]"));
  await page.locator("[data-test=estop-engaged]").waitFor();
  await page.mouse.up();
  await page.getByRole("button", { name: "Recover" }).click();
  const onwards = page.getByRole("button", { name: "Continue from line 1" });
  await onwards.waitFor();
  check("behind the recovery the strip names program and line", /page_test.nc was left in line 1/.test(await alarms.innerText()));
  await page.getByRole("button", { name: "Cycle start" }).click();
  await page.getByText("page_test.nc was left in line 1: start from that line").waitFor();
  check("cycle start alone does not give the line up", (await channelState(url)).restart_line === 1);
  await onwards.click();
  await eventually("the line is found", async () => (await channelState(url)).state === "HELD");
  await page.getByRole("button", { name: "Cycle start" }).click();
  await eventually("the program continues", async () => (await channelState(url)).state === "RUNNING");
  await page.getByRole("button", { name: "Reset", exact: true }).click();
  await eventually("reset again", async () => (await channelState(url)).state === "IDLE");
  await post(url, "channels/0/override", { kind: "feed", value: 1 });

  await page.locator("[data-test=functions]").click();
  await page.getByRole("textbox", { name: "State the tool in the spindle" }).pressSequentially("7", hand);
  await page.getByRole("button", { name: "State", exact: true }).click();
  await eventually("the tool in the spindle is stated", async () => (await channelState(url)).tool === 7);
  await page.getByRole("textbox", { name: "Set the count of parts" }).pressSequentially("41", hand);
  await page.getByRole("button", { name: "Set", exact: true }).click();
  await eventually("the count of parts is set", async () => (await channelState(url)).parts === 41);
  await eventually("and shown", async () => (await page.locator("[data-test=parts]").innerText()) === "41");
  await page.getByRole("tab", { name: "Tool path" }).click();
  await page.getByRole("button", { name: "Select…" }).click();
  await page.getByRole("button", { name: /^rtcp.nc/ }).click();
  await eventually("another program is selected", async () => (await channelState(url)).program === "rtcp.nc");
  await page.getByRole("button", { name: "Select…" }).click();
  await page.getByRole("button", { name: "Delete page_test.nc" }).click();
  await page.getByRole("alertdialog", { name: "Delete page_test.nc?" }).getByRole("button", { name: "Delete" }).click();
  await eventually("the program is deleted", async () => (await fetch(`${url}api/programs/page_test.nc`)).status === 404);
  await page.getByRole("button", { name: "Back to text" }).click();
}

async function storedText(page, url) {
  const line = `G0 X1 (${"-".repeat(290)})`;  // 298 columns; the panel has room for fewer than 100
  await fetch(`${url}api/programs/page_long.nc`, { method: "PUT", body: `${line}\nM30\n` });
  await page.getByRole("button", { name: "Select…" }).click();
  await page.getByRole("button", { name: /^page_long.nc/ }).click();
  const shown = page.getByRole("region", { name: "Program text" }).getByText(line);
  await shown.waitFor();
  const cut = await shown.evaluate((element) => element.scrollWidth > element.clientWidth && getComputedStyle(element).textOverflow === "ellipsis");
  check("a line that is longer than the panel ends in a sign", cut);
  check("and can be read whole", (await shown.getAttribute("title")) === line);

  await fetch(`${url}api/programs/page_long.nc`, { method: "PUT", body: "G0 X2 (newer)\nM30\n" });
  await page.getByRole("region", { name: "Program text" }).getByText("G0 X2 (newer)").waitFor();
  check("a newer text of the selected program is shown", true);
  await post(url, "channels/0/select", { program: "rtcp.nc" });
  await eventually("another program is selected", async () => (await channelState(url)).program === "rtcp.nc");
  await fetch(`${url}api/programs/page_long.nc`, { method: "DELETE" });
}

export async function operate(browser, url) {
  const page = await openPage(browser, url);
  await storedText(page, url);
  await mdiLines(page, url);
  await alarmsAndStops(page, url);
  check(`operating logs no errors ${page.complaints}`, page.complaints.length === 0);
  await page.context().close();
}
