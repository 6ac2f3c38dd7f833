// SPDX-License-Identifier: Apache-2.0
import { LineBasicMaterial, Matrix4, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { expect, test } from "vitest";
import type { CarryingAxis, MachineBodies, MachineBody } from "../src/contract";
import { DrawnBodies, isDrawn } from "../src/scene/bodies";
import { placements } from "../src/scene/links";

const linear = (axis: string, direction: number[]): CarryingAxis => ({ axis, rotary: false, direction, point: [0, 0, 0] });
const rotary = (axis: string, direction: number[], point: number[]): CarryingAxis => ({ axis, rotary: true, direction, point });
const xyz = [linear("X", [1, 0, 0]), linear("Y", [0, 1, 0]), linear("Z", [0, 0, 1])];
const cradle = [rotary("A", [-1, 0, 0], [0, 0, -400]), rotary("C", [0, 0, -1], [0, 0, -400])];

// Parameters as in chain.test.ts; tips by `trunnion kins MACHINE forward --tool-length 100`, a program of its own in another
// language. That X and Y carry the workpiece changes nothing of the tip in its frame.
const values: Record<string, number>[] = [{ X: 10, Y: 20, Z: -30, first: 25, second: 40 }, { X: -55, Y: 7, Z: 12, first: -70, second: 200 }];
const machines = [
  {
    name: "ac-table", letters: "AC", workpiece: cradle, tool: xyz,
    tips: [[69.355697323828, -67.097663183944, -146.844532265291], [152.776805703409, -258.941581877552, -299.867563627893]],
  },
  {
    name: "ac-table whose X and Y carry the cradle", letters: "AC",
    workpiece: [linear("Y", [0, -1, 0]), linear("X", [-1, 0, 0]), ...cradle], tool: [linear("Z", [0, 0, 1])],
    tips: [[69.355697323828, -67.097663183944, -146.844532265291], [152.776805703409, -258.941581877552, -299.867563627893]],
  },
  {
    name: "cb-head", letters: "CB", workpiece: [],
    tool: [...xyz, rotary("C", [0, 0, 1], [0.5, -0.1, 220]), rotary("B", [0, 1, 0], [0.2, 0, 220])],
    tips: [[-176.373301713355, -67.130113901751, -55.005664276136], [-17.011468918987, -95.80651219359, 532.633234622826]],
  },
];

const valueOf = (letters: string, position: Record<string, number>) => (letter: string) =>
  position[letter] ?? [position.first!, position.second!][letters.indexOf(letter)]!;

test.each(machines)("the parts of $name are where trunnion kins has the tip", ({ letters, workpiece, tool, tips }) => {
  values.forEach((position, i) => {
    const value = valueOf(letters, position);
    const [table, head] = [placements(workpiece, value).pop()!, placements(tool, value).pop()!];
    const tip = new Vector3(0, 0, -100).applyMatrix4(head).applyMatrix4(table.invert());
    tip.toArray().forEach((one, axis) => expect(one).toBeCloseTo(tips[i]![axis]!, 9));
  });
});

const body = (more: Partial<MachineBody>): MachineBody => ({
  name: "one", side: "workpiece", depth: 2, tool: false, position: [30, 0, -400], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  shape: "box", size: [10, 20, 30], ...more,
});
const machineOf = (...bodies: MachineBody[]): MachineBodies => ({
  channel: 0, derived: false, structure: "[w C' A' b X Y Z (S) t]", workpiece_side: cradle, tool_side: xyz, bodies,
});
const drawn = (machine: MachineBodies, position: Record<string, number>, worldFromWorkpiece = new Matrix4(), ownTool = false) => {
  const made = new DrawnBodies(machine, () => new MeshBasicMaterial(), new LineBasicMaterial());
  made.place((letter) => position[letter] ?? 0, worldFromWorkpiece, ownTool);
  made.group.updateMatrixWorld();
  return made.group.children as Mesh[];
};
const centre = (mesh: Mesh) => new Vector3().setFromMatrixPosition(mesh.matrixWorld).toArray();

test("bodies on the table stay in the frame of the workpiece, those of the base move in it", () => {
  const [table, bed] = drawn(machineOf(body({}), body({ name: "bed", depth: 0, position: [0, 0, -750] })), { A: 90, C: 0 });
  centre(table!).forEach((value, i) => expect(value).toBeCloseTo([30, 0, -400][i]!, 9));
  // A turns the table by 90 degrees about -X through (0, 0, -400): seen from it the bed, 350 mm below, is turned back
  // about +X, to Y = 350.
  centre(bed!).forEach((value, i) => expect(value).toBeCloseTo([0, 350, -400][i]!, 9));
});

test("with the table turned in the picture the base is at rest", () => {
  const value = (letter: string) => ({ A: 35, C: -120 })[letter] ?? 0;
  const table = placements(cradle, value)[2]!;
  const [bed] = drawn(machineOf(body({ depth: 0, position: [1, 2, -750] })), { A: 35, C: -120 }, table);
  centre(bed!).forEach((one, i) => expect(one).toBeCloseTo([1, 2, -750][i]!, 9));
});

test("a shape has the size, the place and the directions of its body", () => {
  const side = { side: "tool" as const, depth: 3, position: [0, 0, 40] };
  const along = [0, 0, 1, 0, 1, 0, -1, 0, 0];  // 90 degrees about Y: Z becomes X
  const [box, cylinder, lying, sphere, hull] = drawn(machineOf(
    body({ ...side }), body({ ...side, shape: "cylinder", size: [10, 60] }),
    body({ ...side, shape: "cylinder", size: [10, 60], rotation: along }), body({ ...side, shape: "sphere", size: [12] }),
    body({ ...side, shape: "hull", size: [], points: [[0, 0, 0], [40, 0, 0], [0, 30, 0], [0, 0, 20]] }),
  ), { X: 100, Z: -5 });
  const extent = (mesh: Mesh) => {
    mesh.geometry.computeBoundingBox();
    const found = mesh.geometry.boundingBox!.clone().applyMatrix4(mesh.matrixWorld);
    return [found.min.toArray(), found.max.toArray()].flat().map((one) => Math.round(1e6 * one) / 1e6);
  };
  expect(extent(box!)).toEqual([95, -10, 20, 105, 10, 50]);
  expect(extent(cylinder!)).toEqual([95, -5, 5, 105, 5, 65]);
  expect(extent(lying!)).toEqual([70, -5, 30, 130, 5, 40]);
  expect(extent(sphere!)).toEqual([94, -6, 29, 106, 6, 41]);
  expect(extent(hull!)).toEqual([100, 0, 35, 140, 30, 55]);
});

test("a body on the tool goes when a tool of the table is in the spindle", () => {
  const probe = body({ side: "tool", depth: 3, tool: true });
  expect(drawn(machineOf(probe), {})[0]!.visible).toBe(true);
  expect(drawn(machineOf(probe), {}, new Matrix4(), true)[0]!.visible).toBe(false);
});

test("derived bodies and none leave the picture to the chain", () => {
  expect(isDrawn(machineOf(body({})))).toBe(true);
  expect(isDrawn({ ...machineOf(body({})), derived: true })).toBe(false);
  expect(isDrawn(machineOf())).toBe(false);
  expect(isDrawn(undefined)).toBe(false);
});
