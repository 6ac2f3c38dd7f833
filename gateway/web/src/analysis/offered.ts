// SPDX-License-Identifier: Apache-2.0
// The signals that a recording offers: its columns, and what follows from its positions.
import { axisColumns, type Column, type Recording } from "./recording";
import { type Quantity, quantityOf } from "./signals";

export interface Signal {
  name: string;
  unit: string;
  /** Computed when it is first asked for. */
  values: () => Float64Array;
}

export interface Axes {
  positions: Map<string, Float64Array>;
  commanded: Map<string, Float64Array>;
  /** X Y Z, as far as they are there. */
  linear: string[];
  /** Every axis. */
  all: string[];
}

export function axesOf(recording: Recording, letters: string): Axes {
  const actual = axisColumns(recording, "actual", letters);
  const positions = actual.size > 0 ? actual : axisColumns(recording, "setpoint", letters);
  const commanded = axisColumns(recording, "commanded", letters);
  return { positions, commanded, linear: [..."XYZ"].filter((letter) => positions.has(letter)), all: [...positions.keys()] };
}

const units: Record<Quantity, string> = { speed: "mm/s", acceleration: "mm/s\u00b2", jerk: "mm/s\u00b3", following: "mm" };

function once(compute: () => Float64Array): () => Float64Array {
  let kept: Float64Array | undefined;
  return () => (kept ??= compute());
}

/** `name` gives the operator's word for a quantity. */
export function offeredSignals(recording: Recording, axes: Axes, name: (quantity: Quantity) => string): Signal[] {
  const own = recording.columns.map(({ name: column, unit, values }: Column): Signal => ({ name: column, unit, values: () => values }));
  const derive = (quantity: Quantity, letters: string[]): Signal => ({
    name: `${name(quantity)} ${letters.join("")}`, unit: units[quantity],
    values: once(() => quantityOf(quantity, letters, axes.positions, axes.commanded, recording.cycles, recording.period) ?? new Float64Array(recording.cycles.length)),
  });
  const quantities: Quantity[] = ["speed", "acceleration", "jerk", ...(axes.commanded.size > 0 ? (["following"] as const) : [])];
  const together = axes.linear.length > 1 ? quantities.map((quantity) => derive(quantity, axes.linear)) : [];
  const single = axes.all.flatMap((letter) => quantities.map((quantity) => derive(quantity, [letter])));
  return [...together, ...own, ...single];
}
