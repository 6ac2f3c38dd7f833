// SPDX-License-Identifier: Apache-2.0
// Whether the state that is shown is as new as an answer: the gateway says with each answer from which sequence of the
// stream on that is so.

export class Shown {
  private sequence = 0;
  private live = false;
  private waiting: { sequence: number; resolve: () => void }[] = [];

  /** Until a state with this sequence is shown. Nothing is waited for without a stream, whose next one begins anew. */
  until(sequence: number): Promise<void> {
    if (!this.live || sequence <= this.sequence) return Promise.resolve();
    return new Promise((resolve) => this.waiting.push({ sequence, resolve }));
  }

  /** `whole`: the first state of a stream, perhaps of another gateway, which counts for itself. */
  shows(sequence: number, whole: boolean): void {
    this.live = true;
    this.sequence = sequence;
    this.release((wanted) => whole || wanted <= sequence);
  }

  ended(): void {
    this.live = false;
    this.release(() => true);
  }

  private release(over: (sequence: number) => boolean): void {
    const due = this.waiting.filter((one) => over(one.sequence));
    this.waiting = this.waiting.filter((one) => !over(one.sequence));
    for (const one of due) one.resolve();
  }
}
