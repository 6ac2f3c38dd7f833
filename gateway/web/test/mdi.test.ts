// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { errorsOf, historyOf, MdiRun, mdiLines, remembered, settleMilliseconds } from "../src/state/mdi";
import type { Alarm, Channel } from "../src/state/model";

const idle = { mode: "MDI", state: "IDLE", reset_count: 3, needs_reset: false } as Channel;
const running = { ...idle, state: "RUNNING" } as Channel;
const none = new Set<string>();
const later = (times: number) => times * (settleMilliseconds + 1);

test("a line is sent only when the channel is idle after the line before it", () => {
  const run = new MdiRun(["G0 X1", "G0 X2"], 3, none);
  expect(run.next(idle, none, 0)).toBe("send");
  run.answered(true, 0);
  // The newest message may still show the state from before the answer.
  expect(run.next(idle, none, settleMilliseconds - 1)).toBe("wait");
  expect(run.next(running, none, later(1))).toBe("wait");
  expect(run.next({ ...running, state: "HELD" } as Channel, none, later(2))).toBe("wait");
  expect(run.next(idle, none, later(3))).toBe("send");
  run.answered(true, later(3));
  expect(run.next(running, none, later(4))).toBe("wait");
  expect(run.next(idle, none, later(5))).toBe("done");
});

test("a reset, an emergency stop, another mode or a new error ends the rest", () => {
  const alarm = (occurrences: number) => ({ instance: 1, number: 1107, part: 0, severity: "ERROR", occurrences }) as Alarm;
  const run = new MdiRun(["G0 X1", "G0 X2"], 3, errorsOf({ a: alarm(1) }));
  run.answered(true, 0);
  expect(run.next({ ...idle, reset_count: 4 }, none, later(1))).toBe("ended");
  expect(run.next({ ...idle, needs_reset: true }, none, later(1))).toBe("ended");
  expect(run.next({ ...idle, mode: "JOG" }, none, later(1))).toBe("ended");
  expect(run.next(idle, errorsOf({ a: alarm(1) }), later(1))).toBe("send");
  expect(run.next(idle, errorsOf({ a: alarm(2) }), later(1))).toBe("ended");
  expect(run.next(idle, errorsOf({ a: { ...alarm(2), severity: "HINT" } }), later(1))).toBe("send");
});

test("one refusal is tried again, because the state may have been old; the second one counts", () => {
  const run = new MdiRun(["?"], 3, none);
  expect(run.answered(false, 0)).toBe(true);
  expect(run.next(idle, none, 1)).toBe("wait");
  expect(run.next(idle, none, later(1))).toBe("send");
  expect(run.answered(false, later(1))).toBe(false);
  expect(run.accepted).toBe(0);
});

test("empty lines are left out; the history has the newest first and nothing twice", () => {
  expect(mdiLines(" G0 X1 \n\n\tM3 S100\n")).toEqual(["G0 X1", "M3 S100"]);
  expect(remembered(["a", "b", "c"], "b", 2)).toEqual(["b", "a"]);
  expect(historyOf('["a",1,"b"]')).toEqual(["a", "b"]);
  for (const damaged of [null, "", "{", "7", "null", '{"a":1}']) expect(historyOf(damaged)).toEqual([]);
});
