// SPDX-License-Identifier: Apache-2.0
// What the switches of a program show and send.
import type { Texts } from "../text/texts";
import type { Channel } from "./model";

export const skipLevels = [1, 2, 3, 4, 5, 6, 7, 8, 9];

export function skips(channel: Channel, level: number): boolean {
  return ((channel.block_skip >> (level - 1)) & 1) === 1;
}

/** The levels to send when `level` is switched over. */
export function levelsWith(channel: Channel, level: number): number[] {
  return skipLevels.filter((one) => skips(channel, one) !== (one === level));
}

/** Indices of the axes to lock when axis `index` is switched over. */
export function locksWith(channel: Channel, index: number): number[] {
  return channel.axes.map((_, i) => i).filter((i) => (channel.locked[i] === 1) !== (i === index));
}

/** Indices of all axes, or none when all of them are locked already. */
export function allLocks(channel: Channel): number[] {
  const all = channel.axes.map((_, i) => i);
  return all.every((i) => channel.locked[i] === 1) ? [] : all;
}

/** The offset of the handwheel, one text for each axis that has some. */
export function offsets(channel: Channel): string[] {
  return channel.handwheel_offset.flatMap((value, i) =>
    value === 0 ? [] : [`${channel.letters[i] ?? "?"} ${value.toFixed(3)}`],
  );
}

/** What is switched on and changes what a program does: the operator must not forget it. */
export function reminders(channel: Channel, text: Texts): string[] {
  const locked = [...channel.letters].filter((_, i) => channel.locked[i] === 1).join("");
  return [
    ...(channel.dry_run ? [text.reminderDryRun] : []),
    ...(locked ? [text.reminderLock(locked)] : []),
    ...(channel.auxiliary_lock ? [text.reminderAuxiliary] : []),
    ...(channel.handwheel_offset_on ? [[text.reminderOffset, ...offsets(channel)].join(" ")] : []),
    ...(channel.retracing ? [text.reminderRetrace] : []),
    ...(channel.suspended ? [text.reminderHeld] : []),
  ];
}
