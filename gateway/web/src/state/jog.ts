// SPDX-License-Identifier: Apache-2.0
// Press and hold: a continuous jog lives only as long as it is renewed, and its stop is sent at once and, when the
// start was still under way, once more after it, because two requests may overtake each other.

export interface JogCommand {
  axis: number;
  /** mm/min or deg/min, signed. */
  speed: number;
  /** mm or degrees; 0 = as long as held. */
  increment: number;
}

export interface JogSender {
  /** Resolves true when the channel accepted. */
  start(command: JogCommand): Promise<boolean>;
  stop(axis: number): Promise<unknown>;
}

export const renewalMilliseconds = 150;

export class JogHold {
  private held: JogCommand | null = null;
  private starting: Promise<boolean> | null = null;
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(private readonly sender: JogSender) {}

  get active(): boolean {
    return this.held !== null;
  }

  press(command: JogCommand): void {
    this.release();
    if (command.increment !== 0) {
      void this.sender.start(command);
      return;
    }
    this.held = command;
    this.send(command);
    this.timer = setInterval(() => {
      // A renewal waits for the answer before it, so that a slow link does not pile them up.
      if (!this.starting) this.send(command);
    }, renewalMilliseconds);
  }

  release(): void {
    const command = this.held;
    if (!command) return;
    this.held = null;
    clearInterval(this.timer);
    void this.sender.stop(command.axis);
    void this.starting?.then(() => {
      // A press of the same axis meanwhile would be stopped by this, which is the safe side.
      void this.sender.stop(command.axis);
    });
  }

  private send(command: JogCommand): void {
    const attempt = this.sender.start(command);
    this.starting = attempt;
    void attempt.then((accepted) => {
      if (this.starting === attempt) this.starting = null;
      if (!accepted && this.held === command) {
        this.held = null;
        clearInterval(this.timer);
      }
    });
  }
}
