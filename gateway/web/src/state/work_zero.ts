// SPDX-License-Identifier: Apache-2.0
// Work offsets from the present position. The displayed workpiece position is the machine's less offset, shifts and tool
// length, so whatever these are, the offset that makes it show `wanted` is the active one plus the difference.

import type { Channel } from "./model";

export const axisLetters = "XYZABCUVW";
/** Index of the offset that is added to every other. */
export const externalOffset = 54;
/** How many setting errors (G54.4 P) are behind it. */
const settingErrors = 7;
/** Of the external one, G54 .. G59, G54.1 P1 .. P48 and the setting errors. */
export const offsetIndices: readonly number[] =
  [externalOffset, ...Array(externalOffset).keys(), ...Array.from({ length: settingErrors }, (_, n) => externalOffset + 1 + n)];

/** Name of a work offset by its index. */
export const offsetName = (index: number) => (index > externalOffset ? `G54.4 P${index - externalOffset}` : index === externalOffset ? "EXT" : index < 6 ? `G${54 + index}` : `G54.1 P${index - 5}`);

/** mm or degrees: value of the chosen offset with which the axis would show `wanted` instead of `shown`. */
export function offsetFor(active: number, shown: number, wanted: number): number {
  // The state has six decimals; a sum of such numbers is one, too.
  return Math.round((active + shown - wanted) * 1e6) / 1e6;
}

const turning = /^G(68(\.[123])?|51(\.1)?|24|16|54\.4 P\d)$/;

/** Active codes that turn, mirror or scale the coordinates, or turn the workpiece: with them a position says nothing about the offset. */
export const hindrances = (modal: readonly string[]) => modal.filter((code) => turning.test(code));

type Position = Pick<Channel, "letters" | "machine" | "workpiece" | "work_offset" | "tool_length" | "modal">;

/** A change of the active work offset on its way to the channel. */
export interface OffsetChange {
  /** By column of axisLetters: by how much, and what the display takes off the machine's position with it. */
  change: readonly number[];
  takenOff: readonly number[];
  /** What else the display depends on. */
  state: string;
}

const stateOf = (one: Position) => JSON.stringify([one.work_offset, one.tool_length, one.modal]);

function takenOff(one: Position): number[] {
  return [...axisLetters].map((letter) => {
    const axis = one.letters.indexOf(letter);
    return axis < 0 ? 0 : (one.machine[axis] ?? 0) - (one.workpiece[axis] ?? 0);
  });
}

/** `before`: the change before this one, which the channel may not have taken over yet. */
export function offsetChange(one: Position, from: readonly number[], to: readonly number[], before?: OffsetChange): OffsetChange {
  const change = to.map((value, i) => value - (from[i] ?? 0));
  const now = before && !isTakenOver(before, one) ? before.takenOff : takenOff(one);
  return { change, takenOff: change.map((by, i) => now[i]! + by), state: stateOf(one) };
}

/** Whether the position that is shown is that with the changed offset. */
export function isTakenOver({ change, takenOff: wanted, state }: OffsetChange, one: Position): boolean {
  if (state !== stateOf(one)) return true;
  const now = takenOff(one);
  // Nearer to the new place than to the old one: encoders at rest are not quite still.
  return [...one.letters].every((letter) => {
    const i = axisLetters.indexOf(letter);
    const by = Math.abs(change[i] ?? 0);
    return by === 0 || Math.abs(now[i]! - wanted[i]!) <= Math.max(by / 2, 1e-5);
  });
}
