// SPDX-License-Identifier: Apache-2.0
// Press and hold: the channel ends a jog without an increment that is not renewed (parameter 04c917, 0.25 s). Each
// press has a number of its own. A renewal never starts a movement, so the stop of another station stays a stop.

export interface JogCommand {
  axis: number;
  /** mm/min or deg/min, signed. */
  speed: number;
  /** mm or degrees; 0 = as long as held. */
  increment: number;
}

export interface JogSender {
  /** Resolves true when the channel accepted. */
  start(command: JogCommand, press: number): Promise<boolean>;
  /** Resolves false when the press has ended. */
  renew(press: number): Promise<boolean>;
  stop(axis: number): Promise<unknown>;
}

/** Three renewals fit into the channel's time, so one may be lost. */
export const renewalMilliseconds = 80;

function pressNumber(): number {
  return (crypto.getRandomValues(new Uint32Array(1))[0] ?? 0) || 1;
}

export class JogHold {
  private held: { command: JogCommand; press: number } | null = null;
  private asking: Promise<boolean> | null = null;
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(private readonly sender: JogSender) {}

  get active(): boolean {
    return this.held !== null;
  }

  press(command: JogCommand): void {
    this.release();
    const press = pressNumber();
    if (command.increment !== 0) {
      void this.sender.start(command, press);
      return;
    }
    const held = { command, press };
    this.held = held;
    this.ask(held, this.sender.start(command, press));
    this.timer = setInterval(() => {
      // A renewal waits for the answer before it, so that a slow link does not pile them up.
      if (!this.asking) this.ask(held, this.sender.renew(press));
    }, renewalMilliseconds);
  }

  release(): void {
    const held = this.held;
    if (!held) return;
    this.end();
    void this.sender.stop(held.command.axis);
  }

  private end(): void {
    this.held = null;
    this.asking = null;
    clearInterval(this.timer);
  }

  private ask(held: JogHold["held"], attempt: Promise<boolean>): void {
    this.asking = attempt;
    void attempt.then((accepted) => {
      if (this.asking === attempt) this.asking = null;
      if (!accepted && this.held === held) this.end();
    });
  }
}
