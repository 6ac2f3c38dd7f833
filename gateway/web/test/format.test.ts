// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { bytes, compact, duration, fixed, limits, refusal, shortNumber, tickTexts, title, typedNumber, unit } from "../src/format";

test("a position never reads minus zero and a negative one has a minus sign", () => {
  expect(fixed(-0.0001)).toBe("0.000");
  expect(fixed(-1.5)).toBe("\u22121.500");
  expect(fixed(12.3456, 4)).toBe("12.3456");
});

test("a typed number has a comma or a point", () => {
  expect([" 1,5 ", "-.5", "\u22123", "1e2", "", "1.2.3", "Infinity"].map((typed) => typedNumber(typed))).toEqual([1.5, -0.5, -3, 100, undefined, undefined, undefined]);
  expect([typedNumber(undefined), typedNumber("  ")]).toEqual([undefined, undefined]);
});

test("numbers to look at", () => {
  expect(compact(0)).toBe("0");
  expect(compact(2.5)).toBe("2.5");
  expect(compact(123456)).toBe("123.5 k");
  expect(bytes(1500)).toBe("1.5 kB");
  expect([1234.56, -0.000123456, 0, NaN].map(shortNumber)).toEqual(["1235", "\u22120.0001235", "0", "\u2013"]);
  expect(duration(3725)).toBe("1:02:05");
});

test("what the catalogue writes for programs is shown for people", () => {
  expect(title("rapid_feed")).toBe("Rapid feed");
  expect(limits(0, 5)).toBe("0 … 5");
  expect(limits(undefined, undefined)).toBe("");
  expect(unit("mm/s2|deg/s2")).toBe("mm/s² or °/s²");
  expect(unit("cycles")).toBe("cycles");
});

test("a refusal names what was not done once", () => {
  expect(refusal("MDI", "MDI:1:4: unknown word")).toBe("MDI:1:4: unknown word");
  expect(refusal("MDI", "no MDI while a program runs")).toBe("MDI: no MDI while a program runs");
  expect(refusal("T1", "T12: not there")).toBe("T1: T12: not there");
});

test("the numbers at an axis have the decimals of its step", () => {
  expect(tickTexts([0, 0.00002, 0.00004], 0.00002)).toEqual(["0.00000", "0.00002", "0.00004"]);
  expect(tickTexts([0, 2.5e-5, 5e-5], 2.5e-5)).toEqual(["0.000000", "0.000025", "0.000050"]);
  expect(tickTexts([-0.1, 0, 0.1 + 0.2], 0.1)).toEqual(["\u22120.1", "0.0", "0.3"]);
  expect(tickTexts([0, 2500, 5000], 2500)).toEqual(["0", "2500", "5000"]);
});
