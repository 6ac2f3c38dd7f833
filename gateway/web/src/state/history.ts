// SPDX-License-Identifier: Apache-2.0
// What the plots and the tool path remember: rings of a fixed size, filled from the messages of the stream.
import type { Channel, MachineState } from "./model";

/** Samples in the order they came; the oldest fall out. */
export class Ring {
  private readonly values: Float64Array;
  private start = 0;
  length = 0;
  /** Counts every row ever pushed, so that a reader knows what is new. */
  pushed = 0;

  constructor(
    readonly capacity: number,
    readonly columns: number,
  ) {
    this.values = new Float64Array(capacity * columns);
  }

  push(row: ArrayLike<number>): void {
    const at = (this.start + this.length) % this.capacity;
    for (let column = 0; column < this.columns; ++column) this.values[at * this.columns + column] = row[column] ?? 0;
    if (this.length < this.capacity) ++this.length;
    else this.start = (this.start + 1) % this.capacity;
    ++this.pushed;
  }

  at(row: number, column: number): number {
    return this.values[((this.start + row) % this.capacity) * this.columns + column] ?? 0;
  }

  column(column: number): number[] {
    return Array.from({ length: this.length }, (_, row) => this.at(row, column));
  }

  clear(): void {
    this.start = this.length = 0;
  }
}

export const historySeconds = 30;
export const maxAxes = 9;
const samplesPerSecond = 20;

/** Time in s, feed in mm/min, then the peak following error of each axis of one channel in mm or degrees. */
export class History {
  readonly samples = new Ring(historySeconds * samplesPerSecond, 2 + maxAxes);
  /** X, Y, Z in mm, machine coordinates, actual. */
  readonly path = new Ring(20000, 3);
  private lastTrace = -1;

  record(seconds: number, state: MachineState, channel: Channel): void {
    const errors = channel.axes.map((number) => Math.abs(state.axes[String(number)]?.following_peak ?? 0));
    this.samples.push([seconds, channel.feed, ...errors]);
    const trace = state.trace;
    if (!trace || trace.first === this.lastTrace) return;
    this.lastTrace = trace.first;
    const columns = ["X", "Y", "Z"].map((letter) => {
      const number = channel.axes[channel.letters.indexOf(letter)];
      return number === undefined ? -1 : trace.axes.indexOf(number);
    });
    for (const row of trace.rows) {
      const point = columns.map((column) => (column < 0 ? 0 : (row[column] ?? 0)));
      const last = this.path.length - 1;
      const moved = last < 0 || point.some((value, axis) => Math.abs(value - this.path.at(last, axis)) > 1e-3);
      if (moved) this.path.push(point);
    }
  }

  clear(): void {
    this.samples.clear();
    this.path.clear();
  }
}
