// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { isEmpty, planeAxes, planeParameter, type PlanePoints } from "../src/state/planes";
import { changes, remember, undoLast } from "../src/state/undo";
import { hindrances, isTakenOver, offsetChange, offsetFor, offsetIndices, offsetName } from "../src/state/work_zero";

test("an offset is named as in a program", () => {
  expect([0, 5, 6, 53, 54, 55, 61].map(offsetName)).toEqual(["G54", "G59", "G54.1 P1", "G54.1 P48", "EXT", "G54.4 P1", "G54.4 P7"]);
  expect(offsetIndices).toHaveLength(62);
  expect(offsetIndices.slice(0, 3)).toEqual([54, 0, 1]);
});

test("with the offset that is set the position shows what was wanted, whatever tool length and shifts are", () => {
  let seed = 3;
  const random = () => ((seed = (seed * 48271) % 2147483647) / 2147483647 - 0.5) * 2000;
  for (let round = 0; round < 1000; ++round) {
    const [machine, active, rest, wanted] = [random(), random(), random(), random()].map((value) => Math.round(value * 1e6) / 1e6) as [number, number, number, number];
    const shown = machine - active - rest;
    // The axis shows machine - offset - rest.
    expect(machine - offsetFor(active, shown, wanted) - rest).toBeCloseTo(wanted, 5);
  }
});

test("a position is used only when it is that with the changed offset", () => {
  const at = (offset: number, more = {}) => ({
    letters: "XZ", machine: [100, 50], workpiece: [100 - offset, 30], work_offset: 0, tool_length: 20, modal: ["G54"], ...more,
  });
  const table = (x: number) => [x, 0, 0, 0, 0, 0, 0, 0, 0];
  const first = offsetChange(at(10), table(10), table(12));
  expect(isTakenOver(first, at(10))).toBe(false);
  expect(isTakenOver(first, at(11.999))).toBe(true);
  // A second change while the position still shows none of them.
  const second = offsetChange(at(10), table(12), table(13), first);
  expect([10, 12, 13].map((offset) => isTakenOver(second, at(offset)))).toEqual([false, false, true]);
  // Back again: the position of before both is not that of after.
  const third = offsetChange(at(12), table(13), table(12), second);
  expect([13, 12].map((offset) => isTakenOver(third, at(offset)))).toEqual([false, true]);
  // What else the display depends on has changed, so the difference says nothing.
  expect(isTakenOver(first, at(10, { tool_length: 30 }))).toBe(true);
  expect(isTakenOver(offsetChange(at(10), table(10), table(10)), at(10))).toBe(true);
});

test("rotated, mirrored, scaled and polar coordinates hinder it", () => {
  expect(hindrances(["G0", "G54", "G69", "G50", "G15", "G49"])).toEqual([]);
  expect(hindrances(["G68.2", "G51", "G51.1", "G24", "G16", "G68"])).toEqual(["G68.2", "G51", "G51.1", "G24", "G16", "G68"]);
  expect(hindrances(["G54", "G54.1 P4", "G54.4 P1"])).toEqual(["G54.4 P1"]);
});

test("a plane is given by its origin, a point on X and a point on the side of Y", () => {
  const tilted: PlanePoints = [[1, 2, 3], [11, 2, 3], [1, 2, 8]];
  // X stays X; the point on Y is along +Z, so Z of the plane is X x Z = -Y.
  expect(planeAxes(tilted)!.x).toEqual([1, 0, 0]);
  expect(planeAxes(tilted)!.z.map((value) => Math.round(value) + 0)).toEqual([0, -1, 0]);
  expect(planeAxes([[0, 0, 0], [1, 1, 1], [2, 2, 2]])).toBeUndefined();
  expect(planeAxes([[0, 0, 0], [0, 0, 0], [2, 2, 2]])).toBeUndefined();
  expect(isEmpty([[1, 1, 1], [1, 1, 1], [1, 1, 1]])).toBe(true);
  expect([planeParameter(0, 1), planeParameter(2, 20)]).toEqual([40500, 42671]);
});

test("changes are taken back from the newest on, and one that is refused stays", async () => {
  const done: string[] = [];
  const answer = (ok: boolean) => ({ ok, status: ok ? 200 : 409, body: undefined, reason: "" });
  remember({ what: "a", undo: async () => (done.push("a"), answer(true)) });
  remember({ what: "b", undo: async () => (done.push("b"), answer(done.length > 1)) });
  await undoLast();
  expect(changes.value.map(({ what }) => what)).toEqual(["a", "b"]);
  await undoLast();
  await undoLast();
  expect([done, changes.value]).toEqual([["b", "b", "a"], []]);
});
