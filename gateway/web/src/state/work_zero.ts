// SPDX-License-Identifier: Apache-2.0
// Work offsets from the present position. The displayed workpiece position is the machine's less offset, shifts and tool
// length, so whatever these are, the offset that makes it show `wanted` is the active one plus the difference.

export const axisLetters = "XYZABCUVW";
/** G54 .. G59 and G54.1 P1 .. P48. */
export const offsetCount = 54;

/** Name of a work offset by its index. */
export const offsetName = (index: number) => (index < 6 ? `G${54 + index}` : `G54.1 P${index - 5}`);

/** mm or degrees: value of the chosen offset with which the axis would show `wanted` instead of `shown`. */
export function offsetFor(active: number, shown: number, wanted: number): number {
  // The state has six decimals; a sum of such numbers is one, too.
  return Math.round((active + shown - wanted) * 1e6) / 1e6;
}

const turning = /^G(68(\.[123])?|51(\.1)?|24|16)$/;

/** Active codes that turn, mirror or scale the coordinates: with them a position says nothing about the offset. */
export const hindrances = (modal: readonly string[]) => modal.filter((code) => turning.test(code));
