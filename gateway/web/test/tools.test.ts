// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { RunState } from "../src/contract";
import { changeLine, mayChange } from "../src/state/tool_change";

test("a tool is changed by the line that an operator types", () => {
  expect(changeLine(12)).toBe("T12 M6");
});

test("a tool is changed only while the channel is at rest and no program is held", () => {
  const busy: RunState[] = ["RUNNING", "HOLDING", "HELD", "WAITING", "INTERRUPTED"];
  expect(mayChange({ state: "IDLE", suspended: false })).toBe(true);
  expect(mayChange({ state: "IDLE", suspended: true })).toBe(false);
  for (const state of busy) expect(mayChange({ state, suspended: false }), state).toBe(false);
});
