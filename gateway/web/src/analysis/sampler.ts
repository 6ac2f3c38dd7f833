// SPDX-License-Identifier: Apache-2.0
// Samples signals from the messages of the stream, with trigger and pre-trigger.
import type { Recording } from "./recording";

export const mostSignals = 16;

export interface Trigger {
  /** Index of the signal. */
  signal: number;
  /** none: everything from the start on. */
  edge: "none" | "rising" | "falling";
  level: number;
}

export type SamplerState = "waiting" | "triggered" | "done";

/** Rows with the cycles they belong to. Signals that come with a message only keep their value until the next one. */
export class Sampler {
  private readonly cycles: Float64Array;
  private readonly values: Float64Array[];
  private start = 0;
  private count = 0;
  private last: number | undefined;
  /** Cycle of the trigger. */
  triggered: number | undefined;
  state: SamplerState = "waiting";

  /** `duration` and `before` in cycles: what is sampled in all, and before the trigger. `capacity` is the most rows. */
  constructor(
    readonly names: readonly string[], readonly units: readonly string[], private readonly trigger: Trigger, private readonly duration: number,
    private readonly before: number, private readonly capacity = 400_000,
  ) {
    this.cycles = new Float64Array(capacity);
    this.values = names.map(() => new Float64Array(capacity));
  }

  get rows(): number {
    return this.count;
  }

  /** A row; rows of cycles that were there already are passed over. */
  push(cycle: number, row: readonly number[]): void {
    if (this.state === "done" || (this.last !== undefined && cycle <= this.last)) return;
    const crossed = this.crosses(row);
    this.last = cycle;
    if (this.count === this.capacity) this.drop(1);
    const at = (this.start + this.count++) % this.capacity;
    this.cycles[at] = cycle;
    row.forEach((value, i) => (this.values[i]![at] = value));
    if (this.state === "waiting" && crossed) {
      this.state = "triggered";
      this.triggered = cycle;
    }
    const first = this.triggered === undefined ? cycle - this.before : this.triggered - this.before;
    while (this.count > 1 && this.cycles[this.start]! < first && (this.trigger.edge !== "none")) this.drop(1);
    if (this.triggered !== undefined && cycle >= this.triggered + this.duration - this.before) this.state = "done";
  }

  stop(): void {
    this.state = "done";
  }

  recording(name: string, period: number): Recording {
    const order = Array.from({ length: this.count }, (_, i) => (this.start + i) % this.capacity);
    return {
      name, period, cycles: Float64Array.from(order, (at) => this.cycles[at]!),
      columns: this.names.map((one, i) => ({ name: one, unit: this.units[i] ?? "", values: Float64Array.from(order, (at) => this.values[i]![at]!) })),
    };
  }

  private crosses(row: readonly number[]): boolean {
    const { edge, level, signal } = this.trigger;
    if (edge === "none") return true;
    if (this.count === 0) return false;
    const before = this.values[signal]![(this.start + this.count - 1) % this.capacity]!;
    const now = row[signal] ?? 0;
    return edge === "rising" ? before < level && now >= level : before > level && now <= level;
  }

  private drop(rows: number): void {
    this.start = (this.start + rows) % this.capacity;
    this.count -= rows;
  }
}
