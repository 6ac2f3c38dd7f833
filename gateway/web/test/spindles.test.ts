// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { SpindleShown } from "../src/contract";
import { emptyState, type MachineState } from "../src/state/model";
import { spindleRows } from "../src/state/spindles";
import { languages } from "../src/text/texts";

const resting: SpindleShown = {
  condition: "SPINDLE_STOPPED", homed: true, angle: 0, gear: 0, reference: 0, master: -1, synchronization_error: 0, correction: 0,
};

function machine(speeds: number[], ...spindles: Partial<SpindleShown>[]): MachineState {
  const drive = { executed: 0, tick: 0, mode: "FOLLOWING" as const, starved: 0, spindle_speed: speeds };
  return { ...emptyState, drive: { ...drive, spindles: spindles.map((one) => ({ ...resting, ...one })) } };
}

test("every spindle has its row, with measured and commanded speed, condition, gear and angle", () => {
  const rows = spindleRows(
    machine([-729.6, 0], { condition: "SPINDLE_ACCELERATING", gear: 2, reference: -1000, angle: 123.4 }, { homed: false }), languages.en);
  expect(rows).toEqual([
    { name: "S1", speed: "\u2212730 / \u22121000", condition: "changes its speed", place: "gear 2 · 123.40°" },
    { name: "S2", speed: "0 / 0", condition: "stopped", place: "no index mark yet" },
  ]);
});

test("a spindle that follows says which one, its error, and whether this is within the window", () => {
  const slave = { gear: 1, reference: 999, master: 0, synchronization_error: -0.124 };
  const shown = (condition: SpindleShown["condition"], language: keyof typeof languages) =>
    spindleRows(machine([1000, 998.6], { gear: 2 }, { ...slave, condition }), languages[language]);
  const rows = shown("SPINDLE_SYNCHRONIZED", "en");
  expect(rows[0]!.coupling).toBeUndefined();
  expect(rows[1]).toEqual({
    name: "S2", speed: "999 / 999", condition: "synchronized", place: "gear 1 · 0.00°",
    coupling: { words: "follows S1, error \u22120.12° in window", within: true },
  });
  expect(shown("SPINDLE_SYNCHRONIZING", "de")[1]!.coupling).toEqual({ words: "folgt S1, Fehler \u22120.12° nicht im Fenster", within: false });
  expect(shown("SPINDLE_SYNCHRONIZED", "zh")[1]!.coupling!.words).toBe("跟随 S1，误差 \u22120.12° 在窗口内");
});

test("without a word of the drive, and on a machine without spindles, there is no row", () => {
  expect(spindleRows(emptyState, languages.en)).toEqual([]);
  expect(spindleRows(machine([]), languages.en)).toEqual([]);
});

test("a spindle whose speed has not come yet has a dash", () => {
  expect(spindleRows(machine([], {}), languages.en)[0]!.speed).toBe("\u2013 / 0");
});
