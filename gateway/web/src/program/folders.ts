// SPDX-License-Identifier: Apache-2.0
// Folders of programs. A name has no slash, so what several names have in common before their first minus is the
// folder: mould-rough.nc and mould-finish.nc are in the folder mould.

export interface Folder<Entry> {
  /** Empty: programs of no folder. */
  name: string;
  entries: Entry[];
}

const folderOf = (name: string) => /^([^-]+)-./.exec(name)?.[1] ?? "";

/** Folders in the order of names, the programs of none last; one program alone makes no folder. */
export function folders<Entry extends { name: string }>(entries: readonly Entry[]): Folder<Entry>[] {
  const counts = new Map<string, number>();
  for (const { name } of entries) counts.set(folderOf(name), (counts.get(folderOf(name)) ?? 0) + 1);
  const found = new Map<string, Entry[]>();
  for (const entry of entries) {
    const folder = (counts.get(folderOf(entry.name)) ?? 0) > 1 ? folderOf(entry.name) : "";
    found.set(folder, [...(found.get(folder) ?? []), entry]);
  }
  return [...found]
    .map(([name, list]) => ({ name, entries: list }))
    .sort((a, b) => Number(a.name === "") - Number(b.name === "") || (a.name < b.name ? -1 : 1));
}

/** Why a program cannot have this name: its characters or its length. */
export const isProgramName = (name: string) => /^(?!\.)[A-Za-z0-9._-]{1,64}$/.test(name);
