// SPDX-License-Identifier: Apache-2.0
// What the plots and the tool path remember: rings of a fixed size, filled from the messages of the stream.
import type { Channel, MachineState } from "./model";

/** Samples in the order they came; the oldest fall out. */
export class Ring {
  private readonly values: Float64Array | Float32Array;
  private start = 0;
  length = 0;
  /** Counts every row ever pushed, so that a reader knows what is new. */
  pushed = 0;

  constructor(
    readonly capacity: number,
    readonly columns: number,
    Values: typeof Float64Array | typeof Float32Array = Float64Array,
  ) {
    this.values = new Values(capacity * columns);
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

/** Points of the executed path that are kept. */
export const pathCapacity = 200_001;
/** Columns of the path: the axes X Y Z A B C U V W, the tool, cycles since the row before, and whether a gap is before. */
export const pathColumns = { axes: 9, tool: 9, cycles: 10, gap: 11 } as const;
const letters = "XYZABCUVW";

export const historySeconds = 30;
export const maxAxes = 9;
const samplesPerSecond = 20;

/** Time in s, feed in mm/min, then the peak following error of each axis of one channel in mm or degrees. */
export class History {
  readonly samples = new Ring(historySeconds * samplesPerSecond, 2 + maxAxes);
  /** Actual positions in machine coordinates, mm and degrees: pathColumns. */
  readonly path = new Ring(pathCapacity, 12, Float32Array);
  /** How often the path was cleared. */
  cleared = 0;
  private lastTrace = -1;
  private lastCycle = Infinity;
  private gap = true;

  record(seconds: number, state: MachineState, channel: Channel): void {
    const errors = channel.axes.map((number) => Math.abs(state.axes[String(number)]?.following_peak ?? 0));
    this.samples.push([seconds, channel.feed, ...errors]);
    const trace = state.trace;
    if (!trace || trace.first === this.lastTrace) return;
    this.lastTrace = trace.first;
    const columns = [...letters].map((letter) => {
      const number = channel.axes[channel.letters.indexOf(letter)];
      return number === undefined ? -1 : trace.axes.indexOf(number);
    });
    trace.rows.forEach((row, index) => {
      const point = columns.map((column) => (column < 0 ? 0 : (row[column] ?? 0)));
      const last = this.path.length - 1;
      const moved = last < 0 || point.some((value, axis) => Math.abs(value - this.path.at(last, axis)) > 1e-3);
      if (!moved) return;
      const cycle = trace.first + (trace.since[index] ?? 0);
      this.path.push([...point, channel.tool, cycle > this.lastCycle ? cycle - this.lastCycle : 1, this.gap ? 1 : 0]);
      this.lastCycle = cycle;
      this.gap = false;
    });
  }

  /** Positions were missed: the next point is not joined to the last one. */
  interrupt(): void {
    this.gap = true;
  }

  clear(): void {
    this.samples.clear();
    this.path.clear();
    this.cleared += 1;
    this.gap = true;
  }
}
