// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { StringStream } from "@codemirror/language";
import { isSource, messageOf, stateOf, withFile } from "../src/plc/load";
import { type State, token } from "../src/plc/structured_text";

test("sources are those that the PLC takes", () => {
  expect(["main.st", "a.xml", "a.exp", "A.EXP", "fast.il", "devices.yaml", "messages.yaml", "modbus.yaml"].every(isSource)).toBe(true);
  expect(["logic_test.st", "other.il", "machine.yaml", "main.st.orig"].some(isSource)).toBe(false);
});

test("a file that is chosen replaces the one of its name", () => {
  const running = [{ name: "fast.st", text: "f", running: "f" }, { name: "main.st", text: "m", running: "m" }];
  const files = withFile(withFile(running, "main.st", "other"), "door.st", "d");
  expect(files.map((file) => [file.name, stateOf(file)])).toEqual([["door.st", "new"], ["fast.st", "same"], ["main.st", "changed"]]);
  expect(stateOf(withFile(files, "main.st", "m")[2]!)).toBe("same");
});

test("a message has its place where it names one", () => {
  expect(messageOf("main.st:3:14: error: there is no variable 'x'")).toEqual({ kind: "error", file: "main.st", line: 3, column: 14, text: "there is no variable 'x'" });
  expect(messageOf("main.st:3:14: warning: the variable 'y' is not used").kind).toBe("warning");
  expect(messageOf("main.n (INT) is new: it begins with its initial value")).toMatchObject({ kind: "note", file: "" });
});

function kinds(lines: string[], list = false): [string, string][] {
  const state: State = { comment: "" };
  return lines.flatMap((line) => {
    const stream = new StringStream(line, 4, 2);
    const found: [string, string][] = [];
    while (!stream.eol()) {
      const kind = token(stream, state, list);
      if (kind) found.push([stream.current(), kind]);
      stream.start = stream.pos;
    }
    return found;
  });
}

test("Structured Text has its colours, also in comments over several lines", () => {
  expect(kinds(["IF on AND n >= 16#FF THEN (* a", "b *) %Y16.0 := TRUE; t : TON; // end"])).toEqual([
    ["IF", "keyword"], ["AND", "keyword"], [">=", "operator"], ["16#FF", "number"], ["THEN", "keyword"], ["(*", "comment"], [" a", "comment"],
    ["b *)", "comment"], ["%Y16.0", "propertyName"], [":=", "operator"], ["TRUE", "keyword"], ["TON", "typeName"], ["// end", "comment"],
  ]);
  expect(kinds(["(* a (* b", "*) c", "*) IF /* d /* e */ f */ IF"])).toEqual([
    ["(*", "comment"], [" a (*", "comment"], [" b", "comment"], ["*)", "comment"], [" c", "comment"], ["*)", "comment"], ["IF", "keyword"],
    ["/*", "comment"], [" d /*", "comment"], [" e */", "comment"], [" f */", "comment"], ["IF", "keyword"],
  ]);
  expect(kinds(["s := 'it$'s'; d := T#1h30m;"])).toEqual([[":=", "operator"], ["'it$'s'", "string"], [":=", "operator"], ["T#1h30m", "number"]]);
  expect(kinds(["METHOD a", "p ?= d; p := NULL;"])).toEqual([["METHOD", "keyword"], ["?=", "operator"], [":=", "operator"], ["NULL", "keyword"]]);
});

test("an instruction is one where a line of a list begins with it", () => {
  expect(kinds(["LD s", "ST %Y0.1"], true)).toEqual([["LD", "keyword"], ["ST", "keyword"], ["%Y0.1", "propertyName"]]);
  expect(kinds(["s := ld;"])).toEqual([[":=", "operator"]]);
  expect(kinds(["e : FALLING_EDGE;"])).toEqual([["FALLING_EDGE", "typeName"]]);
});
