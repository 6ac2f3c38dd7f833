// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { errorsOf, historyOf, MdiRun, mdiLines, remembered } from "../src/state/mdi";
import type { Alarm, Channel } from "../src/state/model";

const idle = { mode: "MDI", state: "IDLE", reset_count: 3, needs_reset: false } as Channel;
const running = { ...idle, state: "RUNNING" } as Channel;
const none = new Set<string>();

test("a line is sent only when the channel is idle after the line before it", () => {
  const run = new MdiRun(["G0 X1", "G0 X2"], 3, none);
  expect(run.next(idle, none)).toBe("send");
  run.accepted = 1;
  expect(run.next(running, none)).toBe("wait");
  expect(run.next({ ...running, state: "HELD" } as Channel, none)).toBe("wait");
  expect(run.next(idle, none)).toBe("send");
  run.accepted = 2;
  expect(run.next(running, none)).toBe("wait");
  expect(run.next(idle, none)).toBe("done");
});

test("a reset, an emergency stop, another mode or a new error ends the rest", () => {
  const alarm = (occurrences: number) => ({ instance: 1, number: 1107, part: 0, severity: "ERROR", occurrences }) as Alarm;
  const run = new MdiRun(["G0 X1", "G0 X2"], 3, errorsOf({ a: alarm(1) }));
  run.accepted = 1;
  expect(run.next({ ...idle, reset_count: 4 }, none)).toBe("ended");
  expect(run.next({ ...idle, needs_reset: true }, none)).toBe("ended");
  expect(run.next({ ...idle, mode: "JOG" }, none)).toBe("ended");
  expect(run.next(idle, errorsOf({ a: alarm(1) }))).toBe("send");
  expect(run.next(idle, errorsOf({ a: alarm(2) }))).toBe("ended");
  expect(run.next(idle, errorsOf({ a: { ...alarm(2), severity: "HINT" } }))).toBe("send");
});

test("empty lines are left out; the history has the newest first and nothing twice", () => {
  expect(mdiLines(" G0 X1 \n\n\tM3 S100\n")).toEqual(["G0 X1", "M3 S100"]);
  expect(remembered(["a", "b", "c"], "b", 2)).toEqual(["b", "a"]);
  expect(historyOf('["a",1,"b"]')).toEqual(["a", "b"]);
  for (const damaged of [null, "", "{", "7", "null", '{"a":1}']) expect(historyOf(damaged)).toEqual([]);
});
