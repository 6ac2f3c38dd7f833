// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { allLocks, levelsWith, locksWith, offsets, reminders } from "../src/state/functions";
import { english } from "../src/text/english";
import { canStart, type Channel, emptyState } from "../src/state/model";

const channel = {
  axes: [0, 1, 2], letters: "XYZ", locked: [0, 1, 0], block_skip: 0b101, handwheel_offset: [0, -0.5, 0],
  handwheel_offset_on: true, dry_run: true, auxiliary_lock: false, retracing: false, suspended: false,
} as unknown as Channel;

test("a level or an axis is switched over and the others stay", () => {
  expect(levelsWith(channel, 2)).toEqual([1, 2, 3]);
  expect(levelsWith(channel, 1)).toEqual([3]);
  expect(locksWith(channel, 0)).toEqual([0, 1]);
  expect(locksWith(channel, 1)).toEqual([]);
});

test("the lock of all axes locks the rest, and unlocks when all are locked", () => {
  expect(allLocks(channel)).toEqual([0, 1, 2]);
  expect(allLocks({ ...channel, locked: [1, 1, 1] })).toEqual([]);
});

test("what changes a program is listed, and nothing else", () => {
  expect(offsets(channel)).toEqual(["Y -0.500"]);
  expect(reminders(channel, english)).toEqual(["dry run", "lock Y", "offset Y -0.500"]);
  const plain = { ...channel, dry_run: false, locked: [0, 0, 0], handwheel_offset_on: false };
  expect(reminders(plain, english)).toEqual([]);
  expect(reminders({ ...plain, suspended: true, retracing: true, auxiliary_lock: true }, english)).toEqual([
    "M S T lock", "retrace", "program held",
  ]);
});

test("a program that is held for MDI goes on in automatic mode only", () => {
  const held = { ...channel, state: "HELD", suspended: true } as Channel;
  expect(canStart(emptyState, { ...held, mode: "MDI" })).toBe(false);
  expect(canStart(emptyState, { ...held, mode: "AUTO" })).toBe(true);
});
