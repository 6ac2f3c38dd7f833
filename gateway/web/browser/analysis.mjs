// SPDX-License-Identifier: Apache-2.0
// Sampling with a trigger on a real cluster; a recording in waveforms, path, table and spectrum with one selection; the
// difference of two runs. How long a million rows take is printed, not judged: it depends on the computer.
import { createWriteStream, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { appears, check, drawn, eventually, hand, inaccessible, knows, mdi, openPage, overflowing, post, settled, shot, told } from "./harness.mjs";

/** As `trunnion export --csv feedback`: a circle of 20 mm in 2 s from cycle `start` on, X with 0.02 mm at 50 Hz. */
function circle(start, offset) {
  const lines = ["cycle,channel,epoch,revision,commanded[0],commanded[1],commanded[2],actual[0],actual[1],actual[2]"];
  for (let i = 0; i < 4096; ++i) {
    const angle = Math.max(0, i - start) * Math.PI / 1000;
    const [x, y] = [20 * Math.cos(angle), 20 * Math.sin(angle)];
    lines.push([i, 0, 0, 1, x, y, 5, x + offset + 0.02 * Math.sin(2 * Math.PI * 0.05 * i), y, 5].join(","));
  }
  return lines.join("\n") + "\n";
}

async function sampling(page, url) {
  await eventually("MDI", async () => (await post(url, "channels/0/mode", { mode: "MDI" })).ok);
  await mdi(url, "G54 G90 G0 X0 Y0", { workpiece: { X: 0, Y: 0 } });
  await page.getByRole("tab", { name: "Sampling" }).click();
  const field = page.getByLabel("Duration, s");
  await field.click();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("1.5", hand);
  await page.getByLabel("Trigger", { exact: true }).selectOption({ label: "rising above" });
  await page.getByLabel("of", { exact: true }).selectOption("actual.X");
  await page.getByLabel("Level").fill("20");
  await page.getByRole("button", { name: "Start sampling" }).click();
  await page.getByText("waits for the trigger").waitFor();
  await mdi(url, "G1 X10 F3000", { workpiece: { X: 10 } });
  await knows(page, "X is at 10", ({ workpiece: [x] }) => Math.abs(x - 10) < 1e-3);
  check("below the level the trigger waits", await appears(page.getByText("waits for the trigger")));
  await mdi(url, "G1 X60", { workpiece: { X: 60 } });
  await mdi(url, "G4 P3000");
  await page.locator("[data-test=rows]").waitFor();
  check("the trigger ends the sampling after its time", Number((await page.locator("[data-test=rows]").innerText()).replace(/\D/g, "")) > 20);
  const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "CSV" }).click()]);
  const [names, ...rows] = (await readFile(await saved.path(), "utf8")).trim().split("\n").map((line) => line.split(","));
  const x = names.indexOf("actual.X");
  const values = rows.map((row) => Number(row[x]));
  check("what was before the trigger is there, and what was after it", values[0] < 20 && values[values.length - 1] > 20);
  const cycles = rows.map((row) => Number(row[0]));
  check("every row has its cycle", cycles.every((cycle, i) => i === 0 || cycle > cycles[i - 1]));
  await shot(page, "analysis-live");
}

/** A recording of the machine itself: started, stopped, opened and deleted on the page. */
async function kept(page, url) {
  await page.getByRole("tab", { name: "Recordings" }).click();
  await page.getByRole("button", { name: "Start recording" }).click();
  await page.getByText(/is being recorded$/).waitFor();
  // 50 mm at 50 mm/s: a second of the machine.
  await mdi(url, "G1 X10 F3000", { workpiece: { X: 10 } });
  await page.getByRole("button", { name: "Stop recording" }).click();
  const open = page.getByRole("button", { name: /^Open .*\.mcap$/ }).last();
  await open.waitFor();
  const name = (await open.getAttribute("aria-label")).slice(5);
  const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name: `Download ${name}` }).click()]);
  check("a recording is downloaded as it is", (await readFile(await saved.path())).subarray(1, 5).toString() === "MCAP");
  await open.click();
  await page.locator("[data-test=rows]").filter({ hasText: /[1-9][\d,.]{2,}/ }).waitFor();
  check("a recording of the machine is opened", true);
  await page.getByRole("button", { name: "Recordings of the machine" }).click();
  await shot(page, "analysis-recordings");
  const findings = await inaccessible(page);
  check(`the list of recordings: axe-core ${findings}`, findings.length === 0);
  await page.getByRole("button", { name: `Delete ${name}` }).click();
  await page.getByRole("alertdialog").getByRole("button", { name: "Delete" }).click();
  await page.getByRole("button", { name: `Open ${name}` }).waitFor({ state: "detached" });
  check("a recording is deleted after a question", true);
  await page.getByRole("button", { name: "Recordings of the machine" }).click();
}

async function recording(page, scratch) {
  const input = page.locator("input[type=file]").first();
  const bad = { name: "bad.csv", mimeType: "text/csv", buffer: Buffer.from("time,x\n1,2\n") };
  await told(page, "bad.csv:1:", () => input.setInputFiles(bad), { refused: true });
  check("a file that is no recording is refused with its line", true);
  writeFileSync(join(scratch, "first.csv"), circle(0, 0));
  writeFileSync(join(scratch, "second.csv"), circle(100, 0.01));
  await input.setInputFiles(join(scratch, "first.csv"));
  await page.locator("[data-test=rows]").filter({ hasText: "4096" }).waitFor();
  const path = page.locator("[data-test=recorded-path]");
  await eventually("the path is drawn", async () => Number(await path.getAttribute("data-points")) === 4096);
  check("waveforms, path and table are there", Number(await page.locator("[data-test=waveforms]").getAttribute("data-lanes")) === 3);

  const waves = page.getByRole("img", { name: /^Waveforms/ });
  const box = await waves.boundingBox();
  await waves.click({ position: { x: box.width / 2, y: 40 } });
  const selected = () => path.getAttribute("data-selected").then(Number);
  await eventually("the middle is selected", async () => Math.abs((await selected()) - 2047) < 10);
  const row = async () => Number(await page.locator("[data-row][aria-selected=true]").getAttribute("data-row"));
  check("a place in the waveforms is selected in path and table", (await row()) === (await selected()));
  await page.keyboard.press("ArrowRight");
  const next = await selected();
  await page.locator("[data-row]").first().click();
  await eventually("the row of the table", async () => (await row()) === (await selected()) && (await selected()) !== next);
  check("a row of the table is selected in all three", true);
  const at = await path.boundingBox();
  const before = await selected();
  await eventually("a point of the path is found", async () => {
    for (let i = 0; i < 12; ++i) {
      await page.mouse.click(at.x + at.width * (0.5 + 0.46 * Math.cos(i / 2)), at.y + at.height * (0.5 + 0.3 * Math.sin(i / 2)));
      await drawn(page);
      if ((await selected()) !== before) return true;
    }
    return false;
  });
  check("a point of the path is selected in all three", (await row()) === (await selected()));

  for (const [quantity, unit] of [["Acceleration", "mm/s²"], ["Jerk", "mm/s³"], ["Following error", "mm"], ["Speed", "mm/s"]]) {
    await page.getByRole("combobox", { name: "Colour by" }).selectOption({ label: quantity });
    await page.getByText(new RegExp(`^0 … [\\d.]+ ${unit}$`)).waitFor();
  }
  check("the path is coloured by speed, acceleration, jerk and following error", true);

  await page.getByRole("tab", { name: "FFT" }).click();
  await page.locator("details.chooser summary").click();
  await page.getByRole("button", { name: /^Acceleration X / }).click();
  await page.locator("details.chooser summary").click();
  await page.getByRole("combobox", { name: "Signal of the spectrum" }).selectOption("Acceleration X");
  // 4096 rows of 1 ms: the line nearest to 50 Hz is 205 / 4.096 s = 50.05 Hz.
  await eventually("the vibration is found", async () => /Largest at 50\.05 Hz/.test(await page.locator("[data-test=peak]").innerText()));
  check(`the spectrum names its largest line: ${await page.locator("[data-test=peak]").innerText()}`, true);
  await shot(page, "analysis-spectrum");
  await page.getByRole("tab", { name: "Path" }).click();

  await page.locator("input[type=file]").nth(1).setInputFiles(join(scratch, "second.csv"));
  const worst = page.locator("[data-test=worst]");
  await worst.waitFor();
  // The second run starts 100 cycles, five periods of the vibration, later and is 0.01 mm off in X. Its start is found when
  // an axis has moved by 0.01 mm, and the vibration moves it: both have the same phase, so only the offset is left.
  await page.getByRole("combobox", { name: "Rows that belong together" }).selectOption({ label: "of the same cycle" });
  await eventually("another cycle, another place", async () => /actual\[0\] −?[1-9]/.test(await worst.innerText()));
  check("the difference of the same cycles shows the delay", true);
}

async function real(page, file) {
  await page.locator("input[type=file]").first().setInputFiles(file);
  await page.locator("[data-test=rows]").filter({ hasText: /16\d\d\d/ }).waitFor();
  await page.getByRole("combobox", { name: "Coordinates" }).selectOption({ label: "on the workpiece" });
  await page.getByRole("textbox", { name: "Tool length, mm" }).fill("100");
  await page.getByRole("textbox", { name: "Tool length, mm" }).blur();
  await page.locator(".notice").waitFor({ state: "detached" });
  const place = await page.getByRole("img", { name: /^Waveforms/ }).boundingBox();
  for (const [part, modifiers] of [[0.3, []], [0.8, ["Shift"]]])
    await page.getByRole("img", { name: /^Waveforms/ }).click({ position: { x: place.width * part, y: 40 }, modifiers });
  await eventually("the time between the cursors is shown", async () => Number(await page.locator("[data-test=cursor-time]").innerText()) > 5);
  check("two cursors give the time between them", true);
  await settled(page);
  await shot(page, "analysis");
  const cut = await overflowing(page);
  check(`an exported recording fits ${cut}`, cut.length === 0);
  const findings = await inaccessible(page);
  check(`axe-core ${findings}`, findings.length === 0);
  await page.locator("input[type=file]").nth(1).setInputFiles(file);
  await page.locator("[data-test=worst]").waitFor();
  check("a recording is the same as itself", /actual\.X 0 /.test(`${await page.locator("[data-test=worst]").innerText()} `));
}

async function million(page, scratch) {
  const file = join(scratch, "million.csv");
  const out = createWriteStream(file);
  out.write("cycle,channel,epoch,revision,commanded[0],commanded[1],commanded[2],commanded[3],commanded[4],actual[0],actual[1],actual[2],actual[3],actual[4]\n");
  let block = [];
  for (let i = 0; i < 1_000_000; ++i) {
    const [x, y] = [80 * Math.cos(i / 5000), 80 * Math.sin(i / 5000)];
    block.push(`${i},0,0,1,${x},${y},${-i / 1e4},12.5,18.25,${x + 0.01},${y - 0.01},${-i / 1e4},12.5,18.25`);
    if (block.length === 20_000) {
      if (!out.write(block.join("\n") + "\n")) await new Promise((resolve) => out.once("drain", resolve));
      block = [];
    }
  }
  await new Promise((resolve) => out.end(resolve));
  const began = Date.now();
  await page.locator("input[type=file]").first().setInputFiles(file);
  await page.locator("[data-test=rows]").filter({ hasText: "1000000" }).waitFor();
  const shown = Date.now() - began;
  const path = page.locator("[data-test=recorded-path]");
  await eventually("the path of all is drawn", async () => Number(await path.getAttribute("data-points")) === 150_000);
  const read = Number(await page.locator("[data-test=took]").getAttribute("data-milliseconds"));
  console.log(`     a million rows of 14 columns (${Math.round((await import("node:fs")).statSync(file).size / 1e6)} MB): read in ${Math.round(read)} ms, shown after ${shown} ms, with the path after ${Date.now() - began} ms`);
  check("a million rows are opened", true);
  await page.getByRole("button", { name: "zoom in" }).click();
  await shot(page, "analysis-million");
}

export async function analysis(browser, url) {
  const scratch = mkdtempSync(join(tmpdir(), "trunnion-analysis-"));
  try {
    const page = await openPage(browser, url, { acceptDownloads: true });
    await page.getByRole("navigation", { name: "Views" }).getByRole("button", { name: "Analysis", exact: true }).click();
    await sampling(page, url);
    await kept(page, url);
    await recording(page, scratch);
    if (process.env.EXPORTED) await real(page, process.env.EXPORTED);
    await million(page, scratch);
    check(`the analysis logs no errors ${page.complaints}`, page.complaints.length === 0);
    await page.context().close();
  } finally {
    rmSync(scratch, { recursive: true, force: true });
  }
}
