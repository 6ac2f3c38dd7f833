// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { isEmpty, planeAxes, planeParameter, type PlanePoints } from "../src/state/planes";
import { changes, remember, undoLast } from "../src/state/undo";
import { hindrances, offsetFor, offsetName } from "../src/state/work_zero";

test("an offset is named as in a program", () => {
  expect([0, 5, 6, 53].map(offsetName)).toEqual(["G54", "G59", "G54.1 P1", "G54.1 P48"]);
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

test("rotated, mirrored, scaled and polar coordinates hinder it", () => {
  expect(hindrances(["G0", "G54", "G69", "G50", "G15", "G49"])).toEqual([]);
  expect(hindrances(["G68.2", "G51", "G51.1", "G24", "G16", "G68"])).toEqual(["G68.2", "G51", "G51.1", "G24", "G16", "G68"]);
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
