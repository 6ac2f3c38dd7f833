// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { declared, devices, inputBits, listProgram, Paths, sourceLines } from "../src/plc/source";

const source = `(* main task (* or another *)
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

test("a block with methods, and a class, have their own variables alone", () => {
  const text = `FUNCTION_BLOCK FINAL Pump EXTENDS Device
VAR n : INT; END_VAR
METHOD start VAR_INPUT speed : INT; END_VAR
n := speed;
END_METHOD
n := n + 1;
END_FUNCTION_BLOCK
CLASS Clock
VAR t : INT; END_VAR
METHOD PUBLIC tick t := t + 1; END_METHOD
END_CLASS
class := 1;
`;
  const lines = sourceLines(text);
  expect(lines[3]).toMatchObject({ unit: "Pump", kind: "FUNCTION_BLOCK", names: ["n", "speed"] });
  expect(lines[5]).toMatchObject({ unit: "Pump", kind: "FUNCTION_BLOCK", names: ["n"] });
  expect(lines[9]).toMatchObject({ unit: "Clock", kind: "FUNCTION_BLOCK" });
  expect(lines[11]!.unit).toBe("");
  expect(declared(text, "Pump")).toEqual(["n"]);
  expect(declared(text, "Clock")).toEqual(["t"]);
});

test("a comment begins in no string, also of wide characters", () => {
  const lines = sourceLines(`a := "(*"; b := 'x /*';\nc := "it$"s // d"; e := 1;`);
  expect(lines.map(({ names }) => names)).toEqual([["a", "b"], ["c", "e"]]);
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

test("inputs are those that sources and devices name", () => {
  const text = "PROGRAM main VAR closed AT %X16.0 : BOOL; END_VAR x := %IX2.7 OR %Y1.0; (* %X9.9 %X9.0 *)";
  const everywhere = ["emergency_stop_button", "reset_button", "feed_hold_button"].map((name, bit) => ({ address: `%X0.${bit}`, name }));
  const yaml = "door:\n  actuator: {extended: X17.0, retract: Y17.1} # X20.1\n";
  expect(inputBits([{ name: "main.st", text }, { name: "devices.yaml", text: yaml }, { name: "a.exp", text: "y := %X18.3;" }, { name: "modbus.yaml", text: "X1.1" }])).toEqual([
    ...everywhere, { address: "%X2.7", name: "" }, { address: "%X4.5", name: "probe_contact" }, { address: "%X16.0", name: "closed" }, { address: "%X17.0", name: "" },
    { address: "%X18.3", name: "" },
  ]);
  expect([...devices(["simulation.door.position", "simulation.door.extend", "main.n"])]).toEqual([["door", ["simulation.door.position", "simulation.door.extend"]]]);
});

test("a step of a chart is shown with its state", () => {
  const lines = sourceLines(`<?xml version="1.0"?>
<project>
<pou name="main" pouType="program">
<step localId="1" name="fill" initialStep="true">
</step></pou></project>`);
  expect(lines[3]).toMatchObject({ names: ["fill.X", "fill.T"], unit: "main", kind: "PROGRAM" });
  expect(lines[4]!.names).toEqual([]);
});

test("a register with a name is found by it, a variable of the program before it", () => {
  const paths = new Paths(["main.m_code_0", "main.code"]);
  expect(paths.find("fin_0", "main")).toBe("fin_0");
  expect(paths.find("PROBE_CONTACT", "main")).toBe("probe_contact");
  expect(paths.find("m_code_0", "main")).toBe("main.m_code_0");
  expect(paths.find("m_code_1", "main")).toBe("m_code_1");
  expect(paths.find("fin_x", "main")).toBeUndefined();
});

test("an instruction list is the program of its file, with the blocks of its numbers", () => {
  expect(listProgram("fast.il")).toBe("fast");
  expect(listProgram("fast.st")).toBe("");
  const lines = sourceLines("LD %X0.3 // TON 9, 1\nTON 3, 500\nfull: R_TRIG 4\nST lamp", "fast");
  expect(lines.map(({ names }) => names)).toEqual([["LD", "%X0.3"], ["TON", "ton_3.Q"], ["full", "R_TRIG", "r_trig_4.Q"], ["ST", "lamp"]]);
  expect(lines.every(({ unit, kind }) => unit === "fast" && kind === "PROGRAM")).toBe(true);
});
