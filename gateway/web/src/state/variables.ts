// SPDX-License-Identifier: Apache-2.0
// Macro variables for a table that one can look through.
import type { Variables } from "../contract";

/** More are found by their number. */
export const mostRows = 200;

/** The variables whose number contains `search` (with or without #), and how many there are beyond the rows. */
export function shownVariables(table: Variables | null, search: string): { rows: [number, number][]; more: number } {
  const wanted = search.trim().replace(/^#/, "");
  const all = (table?.numbers ?? []).map((number, index): [number, number] => [number, table!.values[index] ?? 0]);
  const found = all.filter(([number]) => String(number).includes(wanted));
  return { rows: found.slice(0, mostRows), more: Math.max(0, found.length - mostRows) };
}
