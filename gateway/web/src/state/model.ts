// SPDX-License-Identifier: Apache-2.0
// The state of the cluster as the gateway streams it, and the pure functions that read it.
import type { Alarm, ChannelState, MachineState, Service, Severity } from "../contract";
import { type Json, mergePatch } from "./patch";

export type { Alarm, ChannelState as Channel, MachineState, Mode, RunState, Service, Severity } from "../contract";

export const emptyState: MachineState = { services: {}, alarms: {}, channels: {}, axes: {}, revisions: {} };

/** What comes over the stream: the whole state first, then merge patches; `since` is the sequence they apply to. */
export type Message =
  | { sequence: number; state: Json }
  | { sequence: number; since: number; changes: Json };

export interface Stream {
  sequence: number;
  state: MachineState;
}

export const emptyStream: Stream = { sequence: 0, state: emptyState };

/** The stream after a message, or null when the message does not fit it and the client must connect again. */
export function receive(stream: Stream, message: Message): Stream | null {
  if ("state" in message) {
    return { sequence: message.sequence, state: { ...emptyState, ...(message.state as unknown as MachineState) } };
  }
  if (message.since !== stream.sequence) return null;
  const state = mergePatch(stream.state as unknown as Json, message.changes) as unknown as MachineState;
  return { sequence: message.sequence, state };
}

export function channelNumbers(state: MachineState): number[] {
  return Object.keys(state.channels).map(Number).sort((a, b) => a - b);
}

const severityRank: Record<Severity, number> = { EMERGENCY: 0, ERROR: 1, WARNING: 2, HINT: 3 };

/** The worst first, then the oldest, then by number: an order that does not jump about. */
export function sortedAlarms(state: MachineState): Alarm[] {
  return Object.values(state.alarms).sort(
    (a, b) =>
      severityRank[a.severity] - severityRank[b.severity] ||
      a.since.localeCompare(b.since) ||
      a.number - b.number ||
      a.instance - b.instance ||
      a.part - b.part,
  );
}

export function sortedServices(state: MachineState): (Service & { instance: number })[] {
  return Object.entries(state.services)
    .map(([instance, service]) => ({ ...service, instance: Number(instance) }))
    .sort((a, b) => a.instance - b.instance);
}

export interface AxisRow {
  letter: string;
  index: number;
  number: number;
  unit: "mm" | "deg";
  machine: number;
  workpiece: number;
  distanceToGo: number;
  followingError: number | undefined;
  /** Share of the rated torque, whatever its direction. */
  load: number | undefined;
  enabled: boolean | undefined;
  /** It has its reference. */
  homed: boolean;
}

/** Its drive raises it for each axis without a reference. */
const notHomed = 115;

/** One row of the position display per axis of the channel; what the drive has not reported yet is undefined. */
export function axisRows(state: MachineState, channel: ChannelState): AxisRow[] {
  const unreferenced = new Set(Object.values(state.alarms).filter((alarm) => alarm.number === notHomed).map((alarm) => alarm.part));
  return channel.axes.map((number, index) => {
    const letter = channel.letters[index] ?? "?";
    const axis = state.axes[String(number)];
    return {
      letter,
      index,
      number,
      unit: "ABC".includes(letter) ? "deg" : "mm",
      machine: channel.machine[index] ?? 0,
      workpiece: channel.workpiece[index] ?? 0,
      distanceToGo: channel.distance_to_go[index] ?? 0,
      followingError: axis?.following_error,
      load: axis && Math.abs(axis.torque),
      enabled: axis?.enabled,
      homed: channel.homed || !unreferenced.has(number),
    };
  });
}

/** Alarms that hold the axes until they are reset. */
export function holdingAlarms(state: MachineState): Alarm[] {
  return sortedAlarms(state).filter((alarm) => alarm.reaction !== "SHOW");
}

/** The line of the channel's program that an alarm of the NC language names ("PART.NC:12:5: ..."); 0 when there is none. */
export function failingLine(state: MachineState, channel: ChannelState): number {
  for (const alarm of sortedAlarms(state)) {
    if (alarm.source !== "channel" || alarm.part !== channel.channel || !channel.program) continue;
    if (!alarm.text.startsWith(`${channel.program}:`)) continue;
    const line = Number.parseInt(alarm.text.slice(channel.program.length + 1), 10);
    if (line > 0) return line;
  }
  return 0;
}

/** What leads out of an emergency stop or a stop by an alarm, in this order; nothing moves by it. */
export interface RecoveryStep {
  kind: "release" | "alarms" | "channel";
  /** Of a channel's reset. */
  channel?: ChannelState;
  paths: string[];
}

export function recoverySteps(state: MachineState): RecoveryStep[] {
  const steps: RecoveryStep[] = [];
  if (state.plc?.emergency_stop)
    steps.push({ kind: "release", paths: ["/api/panel/release", "/api/panel/reset"] });
  if (holdingAlarms(state).length > 0) steps.push({ kind: "alarms", paths: ["/api/alarms/reset"] });
  for (const number of channelNumbers(state)) {
    const one = state.channels[String(number)]!;
    if (one.needs_reset) steps.push({ kind: "channel", channel: one, paths: [`/api/channels/${number}/reset`] });
  }
  return steps;
}

/** Why the machine's PLC lets the channel do nothing of this kind; empty when it inhibits nothing. */
export function inhibition(state: MachineState, channel: ChannelState, kind: "start" | "manual", unexplained: string): string {
  const control = state.plc?.channels?.[channel.channel];
  const inhibits = kind === "start" ? control?.start_inhibit : control?.manual_inhibit;
  return inhibits ? control?.reason || unexplained : "";
}

/** Whether cycle start can do anything now; the channel itself decides, this only greys the button. */
export function canStart(state: MachineState, channel: ChannelState): boolean {
  if (state.plc?.emergency_stop || channel.needs_reset) return false;
  if (inhibition(state, channel, "start", "-")) return false;
  if (state.cluster && !state.cluster.ready) return false;
  if (holdingAlarms(state).length > 0) return false;
  if (channel.axes.some((number) => state.axes[String(number)]?.enabled === false)) return false;
  if (channel.suspended && channel.mode !== "AUTO") return false;
  if (channel.state === "HELD" || channel.state === "WAITING" || channel.state === "INTERRUPTED") return true;
  // Idle in MDI there is nothing to start: Execute sends a line.
  return channel.state === "IDLE" && channel.mode === "AUTO" && channel.program !== "";
}
