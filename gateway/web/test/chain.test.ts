// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { Chain, type Vector } from "../src/scene/chain";

// Parameters of configs/machines, by offset. Tips by `trunnion kins MACHINE forward --tool-length 100`, which is a program
// of its own in another language, for the positions "10 20 -30 25 40" and "-55 7 12 -70 200"; it prints 12 digits.
const positions: [Vector, number, number][] = [[[10, 20, -30], 25, 40], [[-55, 7, 12], -70, 200]];
const machines: { name: string; letters: string; parameters: Record<number, number>; tips: Vector[] }[] = [
  {
    name: "ac-table", letters: "AC", parameters: { 425: 35, 426: -1, 431: -1, 437: -400 },
    tips: [[69.355697323828, -67.097663183944, -146.844532265291], [152.776805703409, -258.941581877552, -299.867563627893]],
  },
  {
    name: "bc-table", letters: "BC", parameters: { 425: 45, 427: -1, 431: -1, 432: 0.05, 435: 5, 436: -3, 437: -400 },
    tips: [[81.101813978347, 90.881371695795, -157.388857895721], [303.175847909616, 94.885355491427, -349.718257160585]],
  },
  {
    name: "cb-head", letters: "CB", parameters: { 410: 54, 413: 1, 415: 1, 417: 0.3, 418: -0.1, 420: 0.2, 422: 220 },
    tips: [[-176.373301713355, -67.130113901751, -55.005664276136], [-17.011468918987, -95.80651219359, 532.633234622826]],
  },
  {
    name: "nutating-b-head-c-table", letters: "BC",
    parameters: { 410: 4, 415: Math.SQRT1_2, 416: Math.SQRT1_2, 420: 0.1, 421: -0.2, 422: 190, 425: 5, 431: -1, 435: 10, 436: 20 },
    tips: [[-47.668201434845, -46.175049679471, -116.375376275145], [-147.257260997763, 78.12675203288, 7.406430901007]],
  },
];
const defaults: Record<number, number> = { 402: 1, 932: 1, 936: 1, 940: 1 };
const chainOf = (parameters: Record<number, number>) => new Chain((offset) => parameters[offset] ?? defaults[offset] ?? 0);
const anglesOf = (letters: string, first: number, second: number) => {
  const angles = [0, 0, 0, 0, 0, 0];
  [first, second].forEach((angle, i) => (angles["ABCUVW".indexOf(letters[i]!)] = angle));
  return angles;
};

test.each(machines)("the tip of $name is where trunnion kins has it", ({ letters, parameters, tips }) => {
  positions.forEach(([machine, first, second], i) => {
    const tip = chainOf(parameters).tipInWorkpiece(machine, anglesOf(letters, first, second), 100);
    tip.forEach((value, axis) => expect(value).toBeCloseTo(tips[i]![axis]!, 9));
  });
});

test("with rotary axes at zero the spindle face is at the machine position and the tip one tool below", () => {
  for (const { parameters } of machines) {
    const head = chainOf(parameters).headAt([1, 2, 3], [0, 0, 0, 0, 0, 0], 50);
    head.face.forEach((value, axis) => expect(value).toBeCloseTo([1, 2, 3][axis]!, 9));
    head.tip.forEach((value, axis) => expect(value).toBeCloseTo([1, 2, -47][axis]!, 9));
  }
});

test("a turn of the table leaves its pivots where they are and is undone by its inverse", () => {
  const chain = chainOf(machines[0]!.parameters);
  const angles = anglesOf("AC", 30, -75);
  for (const pivot of chain.tablePivots(angles)) pivot.position.forEach((value, axis) => expect(value).toBeCloseTo([0, 0, -400][axis]!, 9));
  const point: Vector = [12, -7, -350];
  chain.workpieceFromWorld(chain.worldFromWorkpiece(point, angles), angles).forEach((value, axis) => expect(value).toBeCloseTo(point[axis]!, 9));
});

test("the pivots of a head keep their distances when they turn", () => {
  const chain = chainOf(machines[2]!.parameters);
  const distance = (a: Vector, b: Vector) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  for (const angles of [anglesOf("CB", 0, 0), anglesOf("CB", 70, -35)]) {
    const head = chain.headAt([5, 6, 7], angles, 80);
    expect(distance(head.tip, head.face)).toBeCloseTo(80, 9);
    expect(distance(head.face, head.pivots[0]!.position)).toBeCloseTo(Math.hypot(0.2, 220), 9);
    expect(distance(head.pivots[0]!.position, head.pivots[1]!.position)).toBeCloseTo(Math.hypot(0.3, 0.1), 9);
    expect(distance(head.pivots[1]!.position, head.ram)).toBeCloseTo(0, 9);
  }
});
