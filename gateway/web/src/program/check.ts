// SPDX-License-Identifier: Apache-2.0
// The control checks what is typed, a moment after the last key; an answer to an older text is not used.
import type { Answer } from "../api";
import type { ProgramCheck } from "../contract";

export const pauseMilliseconds = 400;
/** The gateway takes no larger body. */
export const mostBytes = 1 << 20;

export type CheckState = { kind: "none" | "checking" | "too-large" } | { kind: "done"; result: ProgramCheck } | { kind: "failed"; reason: string };

export class Checker {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private asked = 0;

  constructor(
    private readonly ask: (text: string) => Promise<Answer<ProgramCheck>>,
    private readonly show: (state: CheckState) => void,
    private readonly pause = pauseMilliseconds,
  ) {}

  /** Checks what `text` gives when nothing changes for the pause. */
  changed(text: () => string): void {
    clearTimeout(this.timer);
    const mine = ++this.asked;
    this.timer = setTimeout(() => void this.run(text(), mine), this.pause);
  }

  stop(): void {
    clearTimeout(this.timer);
    ++this.asked;
  }

  private async run(text: string, mine: number): Promise<void> {
    if (new Blob([text]).size > mostBytes) return this.show({ kind: "too-large" });
    this.show({ kind: "checking" });
    const answer = await this.ask(text);
    if (mine !== this.asked) return;
    this.show(answer.ok && answer.body ? { kind: "done", result: answer.body } : { kind: "failed", reason: answer.reason });
  }
}
