// SPDX-License-Identifier: Apache-2.0
// How long a program has run, in machine time: the drive's periods from its start on, holds included.
import type { Channel } from "./model";

type Observed = Pick<Channel, "mode" | "state" | "suspended">;

const runs = (channel: Observed) => channel.suspended || (channel.mode === "AUTO" && channel.state !== "IDLE");

export class RunTime {
  private start = 0;
  private active = false;
  private seen = false;
  /** Periods of the drive since the start, or of the last run when none is active. */
  ticks = 0;
  /** The start was before the first observation, so the time is longer. */
  partial = false;

  observe(channel: Observed, tick: number): void {
    const active = runs(channel);
    if (active && (!this.active || tick < this.start)) {
      this.start = tick;
      this.partial = !this.seen || this.active;
    }
    if (active) this.ticks = tick - this.start;
    this.active = active;
    this.seen = true;
  }
}
