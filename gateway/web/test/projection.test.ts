// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { fit, gridStep, project } from "../src/state/projection";

const flat = { turn: 0, tilt: 0 };

test("the plane views drop the third coordinate", () => {
  expect(project("XY", flat, 1, 2, 3)).toEqual([1, 2]);
  expect(project("XZ", flat, 1, 2, 3)).toEqual([1, 3]);
  expect(project("YZ", flat, 1, 2, 3)).toEqual([2, 3]);
});

test("3D: level it shows X right and Z up, from above it shows the XY plane", () => {
  expect(project("3D", flat, 1, 2, 3)).toEqual([1, 3]);
  const [right, up] = project("3D", { turn: 0, tilt: 90 }, 1, 2, 3);
  expect(right).toBeCloseTo(1);
  expect(up).toBeCloseTo(2);
});

test("everything fits inside the margins with up upwards", () => {
  const points: [number, number][] = [[-100, 0], [300, 50]];
  const { scale, offsetX, offsetY } = fit(points, 440, 240, 20);
  expect(scale).toBe(1); // 400 mm on 400 px, the height would allow 4
  expect([offsetX - 100, offsetX + 300]).toEqual([20, 420]);
  expect(offsetY - 50).toBe(95); // centre 120, half of 50 mm above it
});

test("grid steps are 1, 2 or 5 times a power of ten", () => {
  expect(gridStep(1, 60)).toBe(100);
  expect(gridStep(3, 60)).toBe(20);
  expect(gridStep(15, 60)).toBeCloseTo(5);
  expect(gridStep(100, 60)).toBeCloseTo(1);
});
