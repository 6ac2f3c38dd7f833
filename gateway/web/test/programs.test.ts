// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { Drafts, mostKept, type Storage } from "../src/program/drafts";
import { folders, isProgramName } from "../src/program/folders";
import { aboutCode, codeName, explainedAt, tokens } from "../src/program/g_code";
import { outline } from "../src/program/outline";

const kinds = (line: string) => tokens(line).map(({ from, to, kind }) => `${line.slice(from, to)}:${kind}`);

test("a line is divided into its words", () => {
  expect(kinds("N10 G01 X-1.5 F200 (cut) ; rest")).toEqual([
    "N10:label", "G01:code", "X-1.5:axis", "F200:word", "(cut):comment", "; rest:comment",
  ]);
  expect(kinds("%")).toEqual(["%:head"]);
  expect(kinds("O0979")).toEqual(["O0979:head"]);
  expect(kinds(":1000 (plate)")).toEqual([":1000:head", "(plate):comment"]);
  expect(kinds("%O1000 G0")).toEqual(["%O1000:head", "G0:code"]);
  expect(kinds("<PLATE-2>")).toEqual(["<PLATE-2>:head"]);
  expect(kinds("% PLATE 2")).toEqual(["%:head", "PLATE 2:comment"]);
  expect(kinds("/2 M8")).toEqual(["/2:skip", "M8:code"]);
  expect(kinds("G0X1Y#101Z[#2+1]")).toEqual(["G0:code", "X1:axis", "Y:axis", "#101:variable", "Z:axis", "[:operator", "#2:variable", "+:operator", "]:operator"]);
  expect(kinds("IF [#1 EQ 2] GOTO 10")[0]).toBe("IF:keyword");
  expect(kinds("(not closed")).toEqual(["(not closed:comment"]);
});

test("codes that the control does not have are marked", () => {
  expect(kinds("G999 M10000")).toEqual(["G999:unknown", "M10000:unknown"]);
  expect(kinds("G1500 M123 M1000")).toEqual(["G1500:code", "M123:code", "M1000:code"]);
  expect(codeName("g01")).toBe("G1");
  expect(codeName("G54.10")).toBe("G54.1");
  expect(codeName("M06")).toBe("M6");
  expect(aboutCode("G00")).toBe("rapid traverse");
  expect(aboutCode("M77")).toBe("");
  expect(explainedAt("N1 G43.4 H1", 5)).toMatchObject({ name: "G43.4", from: 3, to: 8 });
  expect(explainedAt("N1 G43.4 H1", 9)).toBeUndefined();
});

test("the codes of other dialects are not marked", () => {
  expect(tokens("G999 M1000", false).map(({ kind }) => kind)).toEqual(["code", "code"]);
});

test("the tokens of any line are ascending and inside it", () => {
  let seed = 7;
  const random = (n: number) => (seed = (seed * 48271) % 2147483647) % n;
  const letters = "GMXYZNOT%/()[]#;=-+.0123456789 \tifwhile\u00e9";
  for (let round = 0; round < 3000; ++round) {
    const line = Array.from({ length: random(40) }, () => letters[random(letters.length)]).join("");
    let end = 0;
    for (const token of tokens(line)) {
      expect(token.from, line).toBeGreaterThanOrEqual(end);
      expect(token.to, line).toBeGreaterThan(token.from);
      end = token.to;
    }
    expect(end).toBeLessThanOrEqual(line.length);
  }
});

test("the outline names programs, tools, offsets, calls, labels and comments", () => {
  const lines = ["%", "O0012 (plate)", "(first side)", "T3 M6 (mill 10)", "G0 G55 X0", "N20 G1 X5", "M98 P7", "G54.1 P4", "G1 X2"];
  expect(outline(lines).map(({ line, kind, text }) => [line, kind, text])).toEqual([
    [2, "program", "O0012  plate"],
    [3, "comment", "first side"],
    [4, "tool", "T3 M6  mill 10"],
    [5, "offset", "G55"],
    [6, "label", "N20"],
    [7, "call", "M98 P7"],
    [8, "offset", "G54.1 P4"],
  ]);
});

test("programs that begin with a colon or a name are in the outline", () => {
  expect(outline([":1000", "<PLATE-2> (x)"]).map(({ line, kind, text }) => [line, kind, text])).toEqual([
    [1, "program", ":1000"],
    [2, "program", "<PLATE-2>  x"],
  ]);
});

test("labels of every block are no outline", () => {
  const lines = Array.from({ length: 200 }, (_, i) => `N${i} G1 X${i}${i === 100 ? " (pocket)" : ""}`);
  expect(outline(lines).map(({ text }) => text)).toEqual(["N100  pocket"]);
});

test("programs whose names begin alike are in a folder", () => {
  const found = folders(["a.nc", "mould-finish.nc", "mould-rough.nc", "x-1.nc"].map((name) => ({ name })));
  expect(found.map(({ name, entries }) => [name, entries.length])).toEqual([["mould", 2], ["", 2]]);
  expect(isProgramName("part_1.nc")).toBe(true);
  for (const bad of ["", ".nc", "a b", "a/b", "\u00e4.nc", "x".repeat(65)]) expect(isProgramName(bad), bad).toBe(false);
});

class Memory implements Storage {
  readonly kept = new Map<string, string>();
  full = false;
  get length() { return this.kept.size; }
  key(i: number) { return [...this.kept.keys()][i] ?? null; }
  getItem(name: string) { return this.kept.get(name) ?? null; }
  setItem(name: string, value: string) {
    if (this.full) throw new Error("quota");
    this.kept.set(name, value);
  }
  removeItem(name: string) { this.kept.delete(name); }
}

test("text that is not saved is there after a reload", () => {
  const memory = new Memory();
  expect(new Drafts(memory).keep("a.nc", { revision: 3, text: "G0 X1" })).toBe(true);
  const again = new Drafts(memory);
  expect(again.names()).toEqual(["a.nc"]);
  expect(again.of("a.nc")).toEqual({ revision: 3, text: "G0 X1" });
  again.drop("a.nc");
  expect(new Drafts(memory).names()).toEqual([]);
});

test("a browser that keeps nothing, a full one and damaged entries are no error", () => {
  expect(new Drafts(undefined).keep("a.nc", { revision: 1, text: "" })).toBe(false);
  const memory = new Memory();
  const drafts = new Drafts(memory);
  memory.full = true;
  expect(drafts.keep("a.nc", { revision: 1, text: "x" })).toBe(false);
  expect(drafts.of("a.nc")?.text).toBe("x");
  memory.full = false;
  expect(drafts.keep("b.nc", { revision: 1, text: "x".repeat(mostKept + 1) })).toBe(false);
  memory.kept.set("trunnion.draft.c.nc", "{not json");
  memory.kept.set("trunnion.draft.d.nc", "{\"text\":5}");
  expect(new Drafts(memory).names()).toEqual([]);
});
