// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { ManualGuide } from "../src/contract";
import { displacementsBody, emptyNotes, notesFrom, offsetRows, readingsBody, seriesOf, wrongAlpha, wrongDisplacement, wrongReadings } from "../src/measurement/manual";

const reading = (name: string) => ({ name, about: name });
const guide: ManualGuide = {
  channel: 0, kind: "ac-table", title: "", checks: [], optional: ["alpha"], poses: [], vectors: [],
  steps: [{ at: "", use: "", do: "", readings: [reading("x1"), reading("x2")] }],
  values: [reading("tool_radius"), reading("alpha")],
};

test("missing and impossible readings are named", () => {
  expect(wrongReadings(guide, {})).toEqual(["x1", "x2", "tool_radius"]);
  const typed = { x1: "-12,5", x2: "3", tool_radius: "5", alpha: "" };
  expect(wrongReadings(guide, typed)).toEqual([]);
  expect(wrongReadings(guide, { ...typed, tool_radius: "0" })).toEqual(["tool_radius"]);
  expect(wrongReadings(guide, { ...typed, alpha: "4" })).toEqual(["alpha"]);
  expect(wrongReadings(guide, { ...typed, x2: "3 mm" })).toEqual(["x2"]);
});

test("readings are sent as numbers, and empty ones not at all", () => {
  expect(readingsBody(1, { x1: "-12,5", alpha: "" })).toEqual({ channel: 1, readings: { x1: -12.5 } });
});

test("the nine displacements are sent with the angle of their poses", () => {
  const notes = emptyNotes("ac-table");
  notes.displacements[8] = ["0,01", "\u22120.02", "0"];
  const body = displacementsBody(0, notes) as { alpha: number; displacements: number[][] };
  expect(body.alpha).toBe(30);
  expect(body.displacements).toHaveLength(9);
  expect(body.displacements[8]).toEqual([0.01, -0.02, 0]);
  expect(["", "x", "101"].map(wrongDisplacement)).toEqual([true, true, true]);
  expect(["4", "30.5", "91", "30"].map(wrongAlpha)).toEqual([true, true, true, false]);
});

test("notes survive a reload, and those of another machine are not taken", () => {
  const notes = { ...emptyNotes("bc-head"), checked: [0, 2], readings: { b_z1: "1" } };
  notes.displacements[3]![1] = "0.5";
  expect(notesFrom(JSON.stringify(notes), "bc-head")).toEqual(notes);
  expect(notesFrom(JSON.stringify(notes), "ac-table")).toEqual(emptyNotes("ac-table"));
  expect(notesFrom("{", "bc-head")).toEqual(emptyNotes("bc-head"));
  expect(notesFrom('{"kind":"bc-head","displacements":7,"readings":{"b_z1":3},"checked":"x"}', "bc-head"))
    .toEqual({ ...emptyNotes("bc-head"), readings: { b_z1: "" } });
});

test("vectors are rows of each component", () => {
  const rows = offsetRows([{ axis: "A", offset_mm: [0, 0.1, 0] }], [{ axis: "A", offset_mm: [0, 0.25, 0] }]);
  expect(rows).toHaveLength(3);
  expect(rows[1]).toEqual({ axis: "A", component: "Y", before: 0.1, after: 0.25 });
  expect(seriesOf("X over C")).toEqual({ component: "X", axis: "C" });
  expect(seriesOf("Z between A0 and A-90 (Zc)")).toBeUndefined();
});
