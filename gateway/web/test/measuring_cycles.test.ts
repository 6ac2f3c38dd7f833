// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { cycles, lineOf, wrongFields } from "../src/state/measuring_cycles";

const cycle = (name: string) => cycles.find((one) => one.name === name)!;

test("a cycle is called by one line of MDI", () => {
  expect(lineOf(cycle("calibrate"), { diameter: "50", ball: "3" })).toBe("G65 P9810 D50 R3");
  expect(lineOf(cycle("surface"), { axis: "Z", expected: "-12,5", offset: "G54" })).toBe("G65 P9811 Z-12.5 S1");
  expect(lineOf(cycle("bore"), { diameter: "20", search: "4" })).toBe("G65 P9812 D20 Q4");
  expect(lineOf(cycle("boss"), { diameter: "32", height: "20", offset: "G59" })).toBe("G65 P9812 D32 Z20 S6");
  expect(lineOf(cycle("web"), { axis: "Y", width: "40", height: "\u22125" })).toBe("G65 P9813 Y40 Z-5");
  expect(lineOf(cycle("corner"), { expectedX: "0", expectedY: "0", along: "15", offset: "G55" })).toBe("G65 P9814 X0 Y0 I15 S2");
  expect(lineOf(cycle("angle"), { axis: "Y", expected: "-11", apart: "-20" })).toBe("G65 P9815 Y-11 I-20");
});

test("what a cycle does not have is not in its line", () => {
  expect(lineOf(cycle("bore"), { diameter: "20", height: "5", width: "3", ball: "3", offset: "none" })).toBe("G65 P9812 D20");
  expect(lineOf(cycle("pocket"), { axis: "Z", width: "20" })).toBe("G65 P9813 X20");
});

test("missing and impossible values are named", () => {
  expect(wrongFields(cycle("bore"), {})).toEqual(["diameter"]);
  expect(wrongFields(cycle("bore"), { diameter: "0" })).toEqual(["diameter"]);
  expect(wrongFields(cycle("bore"), { diameter: "20 mm" })).toEqual(["diameter"]);
  expect(wrongFields(cycle("boss"), { diameter: "20", height: "" })).toEqual(["height"]);
  expect(wrongFields(cycle("surface"), { expected: "0" })).toEqual([]);
  expect(wrongFields(cycle("surface"), { expected: "1e9" })).toEqual(["expected"]);
  expect(wrongFields(cycle("angle"), { expected: "5", apart: "0" })).toEqual(["apart"]);
  expect(wrongFields(cycle("corner"), { expectedX: "-3", expectedY: "0", along: "-1" })).toEqual(["along"]);
});
