// SPDX-License-Identifier: Apache-2.0
// Several MDI lines, one after the other: the channel takes one line at a time, and the next one only when it is idle
// again. Whatever ends a line other than its own end (reset, alarm, another mode) ends the rest, too.
import type { Alarm, Channel } from "./model";

export const maximumLineLength = 255;

/** The lines of a text that are executed; empty ones are left out. */
export function mdiLines(text: string): string[] {
  return text.split("\n").map((line) => line.trim()).filter((line) => line !== "");
}

/** The newest first, without repetition; at most `size`. */
export function remembered(history: readonly string[], entered: string, size = 50): string[] {
  return [entered, ...history.filter((old) => old !== entered)].slice(0, size);
}

/** A list that was kept as JSON; empty for anything else. */
export function historyOf(stored: string | null): string[] {
  try {
    const list: unknown = JSON.parse(stored ?? "[]");
    return Array.isArray(list) ? list.filter((one): one is string => typeof one === "string") : [];
  } catch {
    return [];
  }
}

type Observed = Pick<Channel, "mode" | "state" | "reset_count" | "needs_reset">;

/** Errors that are active: what is new among them ends the run. */
export function errorsOf(alarms: Record<string, Alarm>): Set<string> {
  const errors = Object.values(alarms).filter((alarm) => alarm.severity === "ERROR" || alarm.severity === "EMERGENCY");
  return new Set(errors.map((alarm) => [alarm.instance, alarm.number, alarm.part, alarm.occurrences].join("/")));
}

export class MdiRun {
  /** Lines that the channel has accepted. */
  accepted = 0;

  constructor(
    readonly lines: readonly string[],
    private readonly resets: number,
    private readonly errors: ReadonlySet<string>,
  ) {}

  /** What to do now; "ended" means that the rest must not be executed. */
  next(channel: Observed, errors: ReadonlySet<string>): "send" | "wait" | "done" | "ended" {
    if (channel.reset_count !== this.resets || channel.needs_reset || channel.mode !== "MDI") return "ended";
    for (const error of errors) if (!this.errors.has(error)) return "ended";
    if (channel.state !== "IDLE") return "wait";
    return this.accepted === this.lines.length ? "done" : "send";
  }
}
