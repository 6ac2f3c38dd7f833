// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { Shown } from "../src/state/shown";

async function isOver(promise: Promise<void>): Promise<boolean> {
  return Promise.race([promise.then(() => true), Promise.resolve().then(() => Promise.resolve()).then(() => false)]);
}

test("an answer is waited for until the stream shows what follows from it", async () => {
  const shown = new Shown();
  expect(await isOver(shown.until(7))).toBe(true);
  shown.shows(5, true);
  expect(await isOver(shown.until(5))).toBe(true);
  const later = shown.until(7);
  shown.shows(6, false);
  expect(await isOver(later)).toBe(false);
  shown.shows(8, false);
  expect(await isOver(later)).toBe(true);
});

test("nothing is waited for when the stream ends or begins anew, perhaps with another gateway", async () => {
  const shown = new Shown();
  shown.shows(100, true);
  const lost = shown.until(101);
  shown.ended();
  expect(await isOver(lost)).toBe(true);
  expect(await isOver(shown.until(200))).toBe(true);
  shown.shows(3, true);
  const other = shown.until(9);
  shown.shows(4, true);
  expect(await isOver(other)).toBe(true);
});
