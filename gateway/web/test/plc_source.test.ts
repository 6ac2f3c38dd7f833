// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { declared, Paths, sourceLines } from "../src/plc/source";

const source = `(* main task
   of two lines: ignored *)
PROGRAM main
VAR code AT %W1 : UINT; changer : TON; END_VAR
code := SEL(strobe, 5, list[2].n); // not_this 'nor this'
text := 'code $' code'; out := %Y16.0 OR changer.Q;
END_PROGRAM
FUNCTION_BLOCK Counter
VAR_INPUT step : UDINT; END_VAR
VAR_OUTPUT n, m : UDINT; END_VAR
VAR timer : TON; END_VAR
n := n + step;
END_FUNCTION_BLOCK
`;

test("names of a line are found without comments and strings", () => {
  const lines = sourceLines(source);
  expect(lines[0]!.names).toEqual([]);
  expect(lines[4]!.names).toEqual(["code", "SEL", "strobe", "list[2].n"]);
  expect(lines[5]!.names).toEqual(["text", "out", "%Y16.0", "OR", "changer.Q"]);
  expect(lines[4]).toMatchObject({ unit: "main", kind: "PROGRAM" });
  expect(lines[11]).toMatchObject({ unit: "Counter", kind: "FUNCTION_BLOCK", names: ["n", "step"] });
  expect(lines[13]!.unit).toBe("");
  expect(lines.map(({ text }) => text).join("\n")).toBe(source);
});

test("a name is that of the program, else of the whole, else a register", () => {
  const paths = new Paths(["main.Code", "main.list[2].n", "total"]);
  expect(paths.find("code", "main")).toBe("main.Code");
  expect(paths.find("LIST[ 2 ].n", "main")).toBe("main.list[2].n");
  expect(paths.find("total", "main")).toBe("total");
  expect(paths.find("%y16.0", "main")).toBe("%Y16.0");
  expect(paths.find("sel", "main")).toBeUndefined();
});

test("instances of a function block are those that have all of its variables", () => {
  expect(declared(source, "Counter")).toEqual(["step", "n", "m"]);
  const paths = new Paths(["fast.a.step", "fast.a.n", "fast.a.m", "fast.list[1].step", "fast.list[1].n", "fast.list[1].m", "main.step", "main.n"]);
  expect(paths.instances(["step", "n", "m"])).toEqual(["fast.a", "fast.list[1]"]);
  expect(paths.instances([])).toEqual([]);
});
