// SPDX-License-Identifier: Apache-2.0
// What the page says of each spindle of the machine.
import type { SpindleCondition } from "../contract";
import { fixed } from "../format";
import type { Texts } from "../text/texts";
import type { MachineState } from "./model";

export interface SpindleRow {
  /** Counts from 1, as in the PLC. */
  name: string;
  /** Measured and commanded, without their unit. */
  speed: string;
  condition: string;
  /** Gear, of a spindle that has them, and angle. */
  place: string;
  /** Of a spindle that follows another one: its master, its error, and whether this is within 10a974. */
  coupling?: { words: string; within: boolean };
}

const spindleName = (index: number) => `S${index + 1}`;

function conditionText(condition: SpindleCondition, t: Texts): string {
  const texts: Record<SpindleCondition, string> = {
    SPINDLE_STOPPED: t.spindleStopped,
    SPINDLE_ACCELERATING: t.spindleAccelerating,
    SPINDLE_AT_SPEED: t.spindleAtSpeed,
    SPINDLE_POSITIONING: t.spindlePositioning,
    SPINDLE_ORIENTED: t.spindleOriented,
    SPINDLE_FOLLOWS_PATH: t.spindleFollowsPath,
    SPINDLE_SYNCHRONIZING: t.spindleSynchronizing,
    SPINDLE_SYNCHRONIZED: t.spindleSynchronized,
  };
  return texts[condition];
}

/** In the order of their numbers; none before the drive has said something. */
export function spindleRows(state: MachineState, t: Texts): SpindleRow[] {
  const { drive } = state;
  return (drive?.spindles ?? []).map((one, index) => {
    const actual = drive?.spindle_speed[index];
    const angle = one.homed ? `${fixed(one.angle, 2)}°` : t.spindleNotHomed;
    const row: SpindleRow = {
      name: spindleName(index),
      speed: `${actual === undefined ? "–" : fixed(actual, 0)} / ${fixed(one.reference, 0)}`,
      condition: conditionText(one.condition, t),
      place: one.gear > 0 ? `${t.spindleGear(one.gear)} · ${angle}` : angle,
    };
    if (one.master < 0) return row;
    const within = one.condition === "SPINDLE_SYNCHRONIZED";
    const words = t.spindleFollows(spindleName(one.master), `${fixed(one.synchronization_error, 2)}°`);
    return { ...row, coupling: { words: `${words} ${within ? t.spindleWithin : t.spindleOutside}`, within } };
  });
}
