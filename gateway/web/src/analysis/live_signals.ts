// SPDX-License-Identifier: Apache-2.0
// What of the stream can be sampled. Positions come for every cycle in real time; everything else with each message,
// up to 20 times a second.
import type { Channel, MachineState } from "../state/model";

export interface LiveSignal {
  name: string;
  unit: string;
  /** Of every cycle: the logical axis whose position it is. */
  axis?: number;
  /** Of every message. */
  value: (state: MachineState, channel: Channel | undefined) => number;
}

export function liveSignals(channel: Channel): LiveSignal[] {
  const axis = (name: string, unit: string, number: number, value: (state: MachineState) => number | undefined): LiveSignal =>
    ({ name, unit, value: (state) => value(state) ?? 0, ...(name.startsWith("actual.") ? { axis: number } : {}) });
  return [
    ...channel.axes.flatMap((number, i) => {
      const letter = channel.letters[i] ?? String(number);
      const unit = "ABC".includes(letter) ? "\u00b0" : "mm";
      const of = (state: MachineState) => state.axes[String(number)];
      return [
        axis(`actual.${letter}`, unit, number, (state) => of(state)?.actual),
        axis(`following.${letter}`, unit, number, (state) => of(state)?.following_peak),
        axis(`velocity.${letter}`, `${unit}/s`, number, (state) => of(state)?.velocity),
        axis(`torque.${letter}`, "", number, (state) => of(state)?.torque),
      ];
    }),
    { name: "feed", unit: "mm/min", value: (_, one) => one?.feed ?? 0 },
    { name: "line", unit: "", value: (_, one) => one?.line ?? 0 },
    { name: "feed_override", unit: "", value: (_, one) => one?.feed_override ?? 0 },
    { name: "spindle_speed", unit: "1/min", value: (state) => state.drive?.spindle_speed[0] ?? 0 },
    { name: "starved", unit: "", value: (state) => state.drive?.starved ?? 0 },
  ];
}

/** Rows of a message: one for each row of its trace, with the message's own values in each; one when there is no new trace. */
export function rowsOf(signals: readonly LiveSignal[], state: MachineState, channel: Channel | undefined): { cycle: number; row: number[] }[] {
  const plain = signals.map(({ value }) => value(state, channel));
  const { trace, drive } = state;
  const rows = (trace?.rows ?? []).map((positions, i) => ({
    cycle: trace!.first + (trace!.since[i] ?? 0),
    row: signals.map(({ axis }, k) => (axis === undefined ? plain[k]! : (positions[trace!.axes.indexOf(axis)] ?? plain[k]!))),
  }));
  // Rows that are the same as the one before are not sent: at the end of the message all is as it was.
  if (drive && drive.executed > (rows[rows.length - 1]?.cycle ?? -1)) rows.push({ cycle: drive.executed, row: rows[rows.length - 1]?.row ?? plain });
  return rows;
}
