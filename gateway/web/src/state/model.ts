// The state of the cluster as the gateway streams it, and the pure functions that read it.
import { type Json, mergePatch } from "./patch";

export type Mode = "AUTO" | "MDI" | "JOG" | "REF";
export type RunState = "IDLE" | "RUNNING" | "HOLDING" | "HELD" | "WAITING" | "INTERRUPTED";
export type Severity = "HINT" | "WARNING" | "ERROR" | "EMERGENCY";

/** Lengths in mm, angles in degrees, feeds in mm/min, spindle speeds in 1/min, as in idl/channel.idl. */
export interface Channel {
  channel: number;
  name: string;
  cycle: number;
  mode: Mode;
  state: RunState;
  program: string;
  program_revision: number;
  line: number;
  lines_total: number;
  progress: number;
  modal: string[];
  feed: number;
  programmed_feed: number;
  spindle_programmed: number;
  feed_override: number;
  rapid_override: number;
  spindle_override: number;
  tool: number;
  length_offset: number;
  tool_length: number;
  work_offset: number;
  rtcp: boolean;
  single_block: boolean;
  optional_stop: boolean;
  axes: number[];
  letters: string;
  machine: number[];
  workpiece: number[];
  distance_to_go: number[];
  homed: boolean;
  dry_run: boolean;
  auxiliary_lock: boolean;
  /** 1 for each axis whose setpoints stand. */
  locked: number[];
  /** Bit 0 is level 1. */
  block_skip: number;
  retracing: boolean;
  /** The program is held while the axes are moved by hand or MDI. */
  suspended: boolean;
  handwheel_offset_on: boolean;
  handwheel_offset: number[];
  /** Line in which the control was switched off in the program, 0 = none. */
  restart_line: number;
  /** What the channel waits for, or empty. */
  detail: string;
}

export interface Axis {
  commanded: number;
  actual: number;
  following_error: number;
  /** Largest following error, by magnitude, since the message before. */
  following_peak: number;
  enabled: boolean;
}

export interface Service {
  service: string;
  copy: number;
  vendor: string;
  host: string;
  pid: number;
  lifecycle: "UNCONFIGURED" | "INACTIVE" | "ACTIVE" | "FAULT" | "ABSENT";
  detail: string;
  frames_per_second: number;
  frames_lost: number;
  uptime: number;
  alive: boolean;
  expected: boolean;
  restarts: number;
  contract: string;
  contract_match: boolean;
}

export interface Alarm {
  instance: number;
  number: number;
  part: number;
  severity: Severity;
  reaction: string;
  source: string;
  text: string;
  cycle: number;
  occurrences: number;
  /** When the gateway saw it first, ISO 8601. */
  since: string;
}

export interface MachineState {
  cluster?: { machine: string; ready: boolean; virtual_time: boolean; lead: number; domain: number };
  services: Record<string, Service>;
  alarms: Record<string, Alarm>;
  channels: Record<string, Channel>;
  axes: Record<string, Axis>;
  drive?: { executed: number; tick: number; mode: number; starved: number; spindle_speed: number[] };
  plc?: { emergency_stop: boolean; feed_hold: boolean; coolant: number[] };
  /** Actual positions since the message before: one row per sample, one column per logical axis of `axes`. */
  trace?: { first: number; axes: number[]; rows: number[][] };
  revisions: { parameters?: number; pending?: number; tools?: number; work_offsets?: number; programs?: number };
}

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

/** The stream after a message, or null when the message does not fit it and the client must connect anew. */
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
  enabled: boolean | undefined;
}

/** One row of the position display per axis of the channel; what the drive has not told yet is undefined. */
export function axisRows(state: MachineState, channel: Channel): AxisRow[] {
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
      enabled: axis?.enabled,
    };
  });
}

/** Whether cycle start can do anything now; the channel itself decides, this only greys the button. */
export function canStart(state: MachineState, channel: Channel): boolean {
  if (state.plc?.emergency_stop) return false;
  if (channel.suspended && channel.mode !== "AUTO") return false;
  if (channel.state === "HELD" || channel.state === "WAITING" || channel.state === "INTERRUPTED") return true;
  return channel.state === "IDLE" && (channel.mode === "AUTO" ? channel.program !== "" : channel.mode === "MDI");
}
