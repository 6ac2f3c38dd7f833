// SPDX-License-Identifier: Apache-2.0
// The calibration with dial and edge finder: what is typed, what is sent, and what comes back as rows.
import type { ManualGuide, ManualVector } from "../contract";
import { typedNumber } from "../format";

/** What is typed, kept over reloads: the work takes hours. */
export interface Notes {
  kind: string;
  /** The checks before that are done, by their place. */
  checked: number[];
  /** Readings by their name. */
  readings: Record<string, string>;
  /** X, Y and Z of the nine poses. */
  displacements: string[][];
  alpha: string;
}

export const emptyNotes = (kind: string): Notes => ({
  kind, checked: [], readings: {}, displacements: Array.from({ length: 9 }, () => ["", "", ""]), alpha: "30",
});

/** Notes that were stored for this kind of machine; empty ones for what is not readable or of another. */
export function notesFrom(stored: string | null, kind: string): Notes {
  const empty = emptyNotes(kind);
  try {
    const found = JSON.parse(stored ?? "null") as Partial<Notes> | null;
    if (found?.kind !== kind) return empty;
    const text = (value: unknown) => (typeof value === "string" ? value : "");
    return {
      kind,
      checked: Array.isArray(found.checked) ? found.checked.filter((one) => Number.isInteger(one)) : [],
      readings: Object.fromEntries(Object.entries(found.readings ?? {}).map(([name, value]) => [name, text(value)])),
      displacements: empty.displacements.map((row, i) => row.map((_, j) => text(found.displacements?.[i]?.[j]))),
      alpha: text(found.alpha) || empty.alpha,
    };
  } catch {
    return empty;
  }
}

const positive = ["tool_radius", "arbor_diameter"];

/** The readings that are missing or wrong, by their name. */
export function wrongReadings(guide: ManualGuide, readings: Record<string, string>): string[] {
  const names = [...guide.steps.flatMap((step) => step.readings), ...guide.values].map(({ name }) => name);
  return names.filter((name) => {
    const typed = readings[name] ?? "";
    if (typed.trim() === "" && guide.optional.includes(name)) return false;
    const value = typedNumber(typed);
    if (value === undefined) return true;
    if (name === "alpha") return value < 5 || value > 90;
    return positive.includes(name) ? value <= 0 || value > 1000 : Math.abs(value) > 1e5;
  });
}

/** The body of the request; empty readings are left out. */
export function readingsBody(channel: number, readings: Record<string, string>): object {
  const given = Object.entries(readings).flatMap(([name, typed]) => {
    const value = typedNumber(typed);
    return value === undefined ? [] : [[name, value] as const];
  });
  return { channel, readings: Object.fromEntries(given) };
}

export const wrongAlpha = (alpha: string): boolean => !/^\d+$/.test(alpha.trim()) || Number(alpha) < 5 || Number(alpha) > 90;

/** A field of the nine poses: a length within 100 mm. */
export function wrongDisplacement(typed: string): boolean {
  const value = typedNumber(typed);
  return value === undefined || Math.abs(value) > 100;
}

export function displacementsBody(channel: number, notes: Notes): object {
  return { channel, alpha: Number(notes.alpha), displacements: notes.displacements.map((row) => row.map((typed) => typedNumber(typed) ?? 0)) };
}

export interface OffsetRow {
  axis: string;
  component: string;
  /** mm */
  before: number;
  after: number;
}

export function offsetRows(before: ManualVector[], after: ManualVector[]): OffsetRow[] {
  return after.flatMap(({ axis, offset_mm }, slot) =>
    [..."XYZ"].map((component, i) => ({ axis, component, before: before[slot]?.offset_mm[i] ?? 0, after: offset_mm[i] ?? 0 })));
}

/** "X over C": the component and the axis; undefined for a line between two poses. */
export function seriesOf(name: string): { component: string; axis: string } | undefined {
  const found = /^([XYZ]) over ([ABC])$/.exec(name);
  return found ? { component: found[1]!, axis: found[2]! } : undefined;
}
