// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { Parameter } from "../src/contract";
import { compareWithDefaults, compareWithFile, importBodies, parseParameters, writeParameters } from "../src/state/parameter_file";

const parameter = (number: number, value: number | string, more: Partial<Parameter> = {}): Parameter => ({
  number, name: `p${number}`, unit: "mm", type: typeof value === "string" ? "text" : "real", minimum: 0, maximum: 100, default: 5, value,
  activation: "save", access: "user", pending: false, help: "", group: "axis", ...more,
});

test("a file is read as the state directory writes it", () => {
  const file = parseParameters('# about\n"100034": 25000  # rapid, mm/min\n100035: 1.5e-3\r\n\'040000\': MILL\n"040955": "w [t] # x"\nnot a parameter\n');
  expect(file.rows.map(({ line, number, value }) => [line, number, value])).toEqual([
    [2, 100034, "25000"], [3, 100035, "1.5e-3"], [4, 40000, "MILL"], [5, 40955, "w [t] # x"],
  ]);
  expect(file.bad).toEqual([{ line: 6, text: "not a parameter" }]);
});

test("what is written is read again with every digit", () => {
  const all = [parameter(1, 0.1 + 0.2), parameter(2, -1e-7, { minimum: -1 }), parameter(40000, 'a "b" # c', { default: "" }), parameter(40001, "yes", { default: "" }), parameter(9, 5)];
  const file = parseParameters(writeParameters(all, false));
  expect(file.bad).toEqual([]);
  expect(file.rows.map(({ value }) => value)).toEqual([String(0.1 + 0.2), "-1e-7", 'a "b" # c', "yes"]);
  expect(compareWithFile(all, file)).toEqual([]);
  expect(parseParameters(writeParameters(all, true)).rows.length).toBe(5);
});

test("a row is named with what is wrong with it", () => {
  const here = [parameter(1, 5), parameter(2, 5), parameter(3, 5, { type: "integer" }), parameter(4, 5), parameter(6, 7), parameter(7, 5, { pending: true, pending_value: 8 })];
  const file = parseParameters("1: 6\n2: 101\n3: 1.5\n4: much\n5: 1\n1: 9\n7: 8\n");
  expect(compareWithFile(here, file).map(({ number, verdict }) => [number, verdict])).toEqual([
    [1, "differs"], [1, "twice"], [2, "limits"], [3, "whole"], [4, "not-a-number"], [5, "unknown"], [6, "only-here"],
  ]);
  expect(importBodies(compareWithFile(here, file))).toEqual([[{ number: 1, value: 6 }]]);
});

test("any text is read without an error, and every line is a row, a bad line, a comment or empty", () => {
  let seed = 9;
  const random = (n: number) => (seed = (seed * 48271) % 2147483647) % n;
  const letters = "0123456789\"':#-. \\neEx\n";
  for (let round = 0; round < 3000; ++round) {
    const text = Array.from({ length: random(60) }, () => letters[random(letters.length)]).join("");
    const { rows, bad } = parseParameters(text);
    expect(rows.length + bad.length).toBeLessThanOrEqual(text.split("\n").length);
    for (const { number } of rows) expect(Number.isInteger(number) && number <= 999999).toBe(true);
  }
});

test("defaults are compared as a file is", () => {
  const here = [parameter(1, 5), parameter(2, 6), parameter(3, "MILL", { default: "" })];
  expect(importBodies(compareWithDefaults(here))).toEqual([[{ number: 2, value: 5 }, { number: 3, text: "" }]]);
});

test("many values are several requests", () => {
  const here = Array.from({ length: 5000 }, (_, i) => parameter(i, 6));
  expect(importBodies(compareWithDefaults(here)).map((body) => body.length)).toEqual([4096, 904]);
});
