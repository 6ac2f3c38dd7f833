// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { follow, lineBreak, ProgramText } from "../src/program/lines";

const text = (value: string) => new ProgramText(new TextEncoder().encode(value));

test("lines end at LF or CR LF, and a last line end makes no empty line", () => {
  const program = text("%1\r\nG0 X1\nM30\n");
  expect(program.count).toBe(3);
  expect([1, 2, 3].map((line) => program.line(line))).toEqual(["%1", "G0 X1", "M30"]);
});

test("lines end at CR, too, alone or among others", () => {
  const program = text("%\rO100\r\rG0 X1\nM30\r\n%\r");
  expect(program.count).toBe(6);
  expect([1, 2, 3, 4, 5, 6].map((line) => program.line(line))).toEqual(["%", "O100", "", "G0 X1", "M30", "%"]);
});

test("the editor cuts a text where its lines end", () => {
  expect(lineBreak("G0 X1\rM30\r")).toBe("\r");
  expect(lineBreak("G0 X1\r\nM30")).toBe("\r\n");
  expect(lineBreak("G0 X1\nM30\r\n")).toBe("\n");
  expect(lineBreak("M30")).toBe("\n");
});

test("a program without a last line end, one of an empty line, and an empty one", () => {
  expect(text("A\nB").line(2)).toBe("B");
  expect(text("\n").count).toBe(1);
  expect(text("\n\nX").line(2)).toBe("");
  expect(text("").count).toBe(0);
  expect(text("A").line(0)).toBe("");
  expect(text("A").line(2)).toBe("");
});

test("characters of several bytes stay whole", () => {
  expect(text("(Fräsen)\n(刀具)").line(2)).toBe("(刀具)");
});

test("a line that is no UTF-8 is shown as Windows-1252, in which older programs are written", () => {
  const program = new ProgramText(Uint8Array.from([0x28, 0x46, 0xdc, 0x52, 0x29, 0x0a, 0x28, 0xc3, 0x9c, 0x29]));
  expect([program.line(1), program.line(2)]).toEqual(["(FÜR)", "(Ü)"]);
});

test("a million lines are indexed and the last one is found", () => {
  const line = "G1 X10.000 Y20.000\n";
  const program = text(line.repeat(1_000_000));
  expect(program.count).toBe(1_000_000);
  expect(program.line(1_000_000)).toBe("G1 X10.000 Y20.000");
});

test("the window follows the line only when it nears an edge and stays inside the program", () => {
  expect(follow(10, 20, 15, 1000)).toBe(10);
  expect(follow(10, 20, 40, 1000)).toBe(34); // 40 - floor(20 / 3)
  expect(follow(10, 20, 3, 1000)).toBe(1);
  expect(follow(1, 20, 1000, 1000)).toBe(981); // 1000 - 20 + 1
  expect(follow(5, 20, 3, 8)).toBe(1);
  expect(follow(5, 20, 0, 1000)).toBe(5);
});
