// SPDX-License-Identifier: Apache-2.0
// The tool tip on the workpiece, from recorded positions of the axes.
import type { Chain } from "../scene/chain";

const rotary = [..."ABCUVW"];

/**
 * X, Y and Z of the tip in the frame of the workpiece for every row, mm; nothing without columns. An axis that has no column
 * is at zero. `toolLength` is from the spindle face to the tip, mm.
 */
export function tipColumns(chain: Chain, columns: Map<string, Float64Array>, toolLength: number): Map<string, Float64Array> {
  const rows = [...columns.values()][0]?.length;
  if (rows === undefined) return new Map();
  const [x, y, z] = [..."XYZ"].map((letter) => columns.get(letter));
  const turning = rotary.map((letter) => columns.get(letter));
  const tip = [new Float64Array(rows), new Float64Array(rows), new Float64Array(rows)] as const;
  for (let row = 0; row < rows; ++row) {
    const angles = turning.map((column) => column?.[row] ?? 0);
    const place = chain.tipInWorkpiece([x?.[row] ?? 0, y?.[row] ?? 0, z?.[row] ?? 0], angles, toolLength);
    tip[0][row] = place[0];
    tip[1][row] = place[1];
    tip[2][row] = place[2];
  }
  return new Map([["X", tip[0]], ["Y", tip[1]], ["Z", tip[2]]]);
}
