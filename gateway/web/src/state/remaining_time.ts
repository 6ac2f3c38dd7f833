// SPDX-License-Identifier: Apache-2.0
// How far a program is in the time that was planned for it: counted on by the executed time, and corrected by the line that is
// executed.
import type { ProgramPlan } from "../contract";
import type { Channel } from "./model";

type Observed = Pick<Channel, "mode" | "state" | "suspended" | "line" | "feed_override" | "retracing">;

export class RemainingTime {
  private last: number | undefined;
  /** Seconds of the plan that are executed. */
  done = 0;

  constructor(private readonly plan: Pick<ProgramPlan, "lines" | "seconds">) {}

  get seconds(): number {
    return Math.max(0, this.plan.seconds - this.done);
  }

  /** `time`: seconds of machine time, from any origin. */
  observe(channel: Observed, time: number): void {
    const passed = this.last === undefined ? 0 : Math.max(0, time - this.last);
    this.last = time;
    if (channel.suspended) return;
    if (channel.mode !== "AUTO" || channel.state === "IDLE") {
      this.done = 0;
      return;
    }
    if (channel.state !== "RUNNING") return;
    const counted = this.done + (channel.retracing ? -1 : 1) * passed * channel.feed_override;
    this.done = this.onLine(channel.line, Math.min(this.plan.seconds, Math.max(0, counted)));
  }

  private end(i: number): number {
    return this.plan.lines.begin[i + 1] ?? this.plan.seconds;
  }

  /** Of stretches that were left out, the one before them has the lines. */
  private covers(i: number, line: number): boolean {
    const { line: lines } = this.plan.lines;
    return lines[i] === line || (lines[i]! < line && line < (lines[i + 1] ?? lines[i]!));
  }

  /** The time nearest to `seconds` at which the program is in `line`; `seconds` when it never is. */
  private onLine(line: number, seconds: number): number {
    const { begin } = this.plan.lines;
    let [low, high] = [0, begin.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (begin[middle]! <= seconds) low = middle + 1;
      else high = middle;
    }
    const at = low - 1;
    let [before, after] = [-1, -1];
    for (let i = at; i >= 0 && before < 0; --i) if (this.covers(i, line)) before = i;
    for (let i = at + 1; i < begin.length && after < 0; ++i) if (this.covers(i, line)) after = i;
    if (before === at && at >= 0) return seconds;
    const [early, late] = [before < 0 ? -Infinity : this.end(before), after < 0 ? Infinity : begin[after]!];
    if (early === -Infinity && late === Infinity) return seconds;
    return seconds - early < late - seconds ? early : late;
  }
}
