// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { Channel } from "../src/state/model";
import { RemainingTime } from "../src/state/remaining_time";

const at = (line: number, more: Partial<Channel> = {}) =>
  ({ mode: "AUTO", state: "RUNNING", suspended: false, retracing: false, feed_override: 1, line, ...more }) as Channel;
// Line 1 takes 2 s, line 2 takes 10 s, line 3 takes 8 s.
const straight = { seconds: 20, lines: { line: [1, 2, 3], begin: [0, 2, 12] } };

test("before the start all of the planned time remains, and after the end again", () => {
  const time = new RemainingTime(straight);
  time.observe(at(0, { state: "IDLE" }), 100);
  expect(time.seconds).toBe(20);
  time.observe(at(1), 101);
  time.observe(at(0, { state: "IDLE" }), 140);
  expect(time.seconds).toBe(20);
});

test("it counts with the feed override and rests in a hold", () => {
  const time = new RemainingTime(straight);
  time.observe(at(1), 0);
  time.observe(at(2), 4);
  expect(time.seconds).toBe(16);
  time.observe(at(2, { feed_override: 0.5 }), 8);
  expect(time.seconds).toBe(14);
  time.observe(at(2, { state: "HELD" }), 50);
  time.observe(at(2, { mode: "MDI", state: "IDLE", suspended: true }), 60);
  expect(time.seconds).toBe(14);
  time.observe(at(2), 61);
  expect(time.seconds).toBe(13);
});

test("the line that is executed corrects what was counted", () => {
  const time = new RemainingTime(straight);
  time.observe(at(1), 0);
  // Counted 9 s, but a tool change took 8 of them: still in line 1, which ends after 2.
  time.observe(at(1), 9);
  expect(time.seconds).toBe(18);
  // A page that was opened late: line 3 is not before 12 s.
  const late = new RemainingTime(straight);
  late.observe(at(3), 500);
  expect(late.seconds).toBe(8);
});

test("of the passes of a loop it takes the one that was counted to", () => {
  // Five passes of line 4 (1 s) and line 5 (1 s).
  const loop = { seconds: 10, lines: { line: [4, 5, 4, 5, 4, 5, 4, 5, 4, 5], begin: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9] } };
  const time = new RemainingTime(loop);
  time.observe(at(4), 0);
  for (let i = 1; i <= 62; ++i) time.observe(at(4 + (Math.floor(i / 10) % 2)), i / 10);
  // 6.2 s: line 4 of the fourth pass.
  expect(time.seconds).toBeCloseTo(3.8, 9);
});

test("lines whose stretches were left out belong to the one before them", () => {
  const coarse = { seconds: 30, lines: { line: [1, 100, 200], begin: [0, 10, 20] } };
  const time = new RemainingTime(coarse);
  time.observe(at(150), 0);
  expect(time.seconds).toBe(20);
});

test("a line that the plan does not have leaves the count", () => {
  const time = new RemainingTime(straight);
  time.observe(at(2), 0);
  time.observe(at(77), 3);
  expect(time.done).toBe(5);
});
