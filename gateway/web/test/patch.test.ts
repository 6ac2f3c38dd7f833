// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { mergePatch } from "../src/state/patch";

test("the examples of RFC 7396, appendix A", () => {
  const cases: [unknown, unknown, unknown][] = [
    [{ a: "b" }, { a: "c" }, { a: "c" }],
    [{ a: "b" }, { b: "c" }, { a: "b", b: "c" }],
    [{ a: "b" }, { a: null }, {}],
    [{ a: "b", b: "c" }, { a: null }, { b: "c" }],
    [{ a: ["b"] }, { a: "c" }, { a: "c" }],
    [{ a: { b: "c" } }, { a: { b: "d", c: null } }, { a: { b: "d" } }],
    [{ a: [{ b: "c" }] }, { a: [1] }, { a: [1] }],
    [["a", "b"], ["c", "d"], ["c", "d"]],
    [{ e: null }, { a: 1 }, { e: null, a: 1 }],
    [[1, 2], { a: "b", c: null }, { a: "b" }],
    [{}, { a: { bb: { ccc: null } } }, { a: { bb: {} } }],
  ];
  for (const [target, patch, result] of cases) expect(mergePatch(target as never, patch as never)).toEqual(result);
});

test("what a patch does not name stays the same object and the target is untouched", () => {
  const target = { channels: { "0": { feed: 1 }, "1": { feed: 2 } }, alarms: {} };
  const merged = mergePatch(target, { channels: { "0": { feed: 3 } } }) as typeof target;
  expect(merged.alarms).toBe(target.alarms);
  expect(merged.channels["1"]).toBe(target.channels["1"]);
  expect(target.channels["0"].feed).toBe(1);
  expect(merged.channels["0"].feed).toBe(3);
});
