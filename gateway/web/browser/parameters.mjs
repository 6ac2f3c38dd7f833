// SPDX-License-Identifier: Apache-2.0
// Parameters on a real cluster: class tree, search, a change and its undo, comparison, import with a preview, export.
import { readFile } from "node:fs/promises";
import { check, eventually, hand, openPage, overflowing, shot } from "./harness.mjs";

const parameter = (url, number) => fetch(`${url}api/parameters/${number}`).then((answer) => answer.json());
const stored = async (url, number) => {
  const one = await parameter(url, number);
  return one.pending ? one.pending_value : one.value;
};
const put = (url, number, body) => fetch(`${url}api/parameters/${number}`, { method: "PUT", body: JSON.stringify(body) });

async function tree(page) {
  const classes = page.getByRole("group", { name: "Class", exact: true });
  await classes.getByRole("button", { name: "Axis", exact: true }).click();
  await classes.getByRole("button", { name: /^2\s+Z$/ }).click();
  await eventually("only axis 2 is listed", async () => {
    const numbers = await page.locator("[data-parameter]").evaluateAll((rows) => rows.map((row) => row.dataset.parameter));
    return numbers.length > 20 && numbers.every((number) => number.startsWith("102"));
  });
  check("the class tree leads to one axis", true);
  await classes.getByRole("button", { name: "All" }).click();
  const search = page.getByRole("searchbox", { name: "Number, name or help" });
  await search.pressSequentially("exact stop", hand);
  await page.locator('[data-parameter="010166"]').waitFor();
  check("the help is searched, too", true);
  await search.fill("");
}

async function change(page, url) {
  await put(url, 100034, { reset: true });
  await eventually("nothing waits", async () => !(await parameter(url, 100034)).pending);
  const before = await stored(url, 100034);
  const search = page.getByRole("searchbox", { name: "Number, name or help" });
  await search.pressSequentially("100034", hand);
  await page.locator('[data-parameter="100034"]').click();
  const field = page.getByLabel(/^Value/);
  await eventually("its value is there", async () => (await field.inputValue()) === String(before));
  await field.click();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("23456.5", hand);
  await page.keyboard.press("Enter");
  await eventually("it is stored", async () => (await stored(url, 100034)) === 23456.5);
  await page.getByText(/is stored and waits for reset/).waitFor();
  check("a value is typed, stored, and said to wait for its activation", true);
  await page.getByRole("button", { name: `Undo: 100034 ${before} → 23456.5` }).click();
  await eventually("it is taken back", async () => (await stored(url, 100034)) === before);
  check("one change is taken back", true);
  await put(url, 100034, { value: 21000 });
  await page.getByRole("button", { name: "Back to the machine's default" }).click();
  await eventually("it is the machine's again", async () => (await stored(url, 100034)) === before);
  check("a parameter goes back to the machine's default", true);
  await search.fill("");
  return before;
}

async function files(page, url, before) {
  await page.getByRole("button", { name: "Compare with defaults" }).click();
  const comparison = page.getByRole("region", { name: "Comparison" }).first();
  await comparison.getByText(/\d+ differ, 0 rejected/).waitFor();
  check("what differs from the defaults is listed", (await comparison.locator("tbody tr").count()) > 10);
  check("and cannot be taken over as a whole", (await comparison.getByRole("button", { name: /Take over/ }).count()) === 0);
  await shot(page, "parameters-defaults");

  const file = '"100034": 19000  # rapid\n"101034": -5\n"000010": wide\n"999999": 1\n"010049": 1.5\nnonsense\n';
  await page.setInputFiles("input[type=file]", { name: "other.yaml", mimeType: "application/yaml", buffer: Buffer.from(file) });
  await comparison.getByText("1 differ, 5 rejected").waitFor();
  const verdicts = await comparison.locator("tbody tr").evaluateAll((rows) => rows.map((row) => row.lastChild.textContent));
  check("rejected rows are named with their reason", ["is no parameter", "this machine has no such parameter", "This is not a number.", "must be a whole number"].every((one) => verdicts.includes(one)));
  check("and with the limits", verdicts.some((one) => /^outside .*…/.test(one)));
  check("nothing is stored before it is agreed to", (await stored(url, 100034)) === before);
  await shot(page, "parameters-import");
  await comparison.getByRole("button", { name: "Take over 1" }).click();
  await page.getByRole("alertdialog", { name: /Store 1 values of other.yaml/ }).getByRole("button", { name: "Take over 1" }).click();
  await eventually("it is stored", async () => (await stored(url, 100034)) === 19000);
  check("the rows that differ are stored together", true);

  const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Export" }).click()]);
  const exported = await readFile(await saved.path(), "utf8");
  check("an export has the stored values", /^"100034": 19000 {2}# rapid_feed/m.test(exported) && /^"040000": MILL/m.test(exported));
  await page.setInputFiles("input[type=file]", { name: "own.yaml", mimeType: "application/yaml", buffer: Buffer.from(exported) });
  await comparison.getByText("Nothing differs.").waitFor();
  check("and is the same when it is compared", true);
  await comparison.getByRole("button", { name: "End" }).click();
  await page.getByRole("button", { name: /^Undo: 1 values of other.yaml/ }).click();
  await eventually("the import is taken back", async () => (await stored(url, 100034)) === before);
  check("an import is taken back as a whole", true);
  const cut = await overflowing(page);
  check(`the parameters fit ${cut}`, cut.length === 0);
}

export async function parameters(browser, url) {
  const page = await openPage(browser, url, { acceptDownloads: true });
  await page.getByRole("navigation", { name: "Views" }).getByRole("button", { name: "Parameters", exact: true }).click();
  await tree(page);
  const before = await change(page, url);
  await files(page, url, before);
  check(`parameters log no errors ${page.complaints}`, page.complaints.length === 0);
  await page.context().close();
}
