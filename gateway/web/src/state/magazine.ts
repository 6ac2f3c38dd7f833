// SPDX-License-Identifier: Apache-2.0
// Where the tools are, from the table that the PLC keeps of its magazine: an array of T numbers, its index the place and
// 0 the spindle. 04c958 names it.

/** Of the delivered programs with one spindle. */
const deliveredTable = "main.changer.tools";

export const tableParameter = (channel: number) => 40000 + 1000 * channel + 958;

/** Path of the variable of the PLC; empty when the channel has no magazine. */
export const tableOf = (channel: number, named: string) => named.trim() || (channel === 0 ? deliveredTable : "");

/** Places by T number; 0 in the table is an empty place. */
export function placesOf(values: ReadonlyMap<string, { value: string }>): ReadonlyMap<number, number> {
  const places = new Map<number, number>();
  for (const [path, { value }] of values) {
    const place = /\[(\d+)\]$/.exec(path);
    const tool = Number(value);
    if (place && Number.isInteger(tool) && tool > 0 && !places.has(tool)) places.set(tool, Number(place[1]));
  }
  return places;
}

/** 0: in the spindle; undefined: in no place. Without a table of the PLC only the channel says where its tool is. */
export function placeOf(tool: number, inSpindle: number, places: ReadonlyMap<number, number>): number | undefined {
  if (places.size > 0) return places.get(tool);
  return tool === inSpindle ? 0 : undefined;
}
