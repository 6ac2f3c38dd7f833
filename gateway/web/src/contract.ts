// SPDX-License-Identifier: Apache-2.0
// Generated from gateway/openapi.json by tools/generate_api.py.
export interface Accepted {
  accepted: true;
  /** Interpolation cycle it was applied at */
  cycle?: number;
}

export type Mode = "AUTO" | "MDI" | "JOG" | "REF";

export type RunState = "IDLE" | "RUNNING" | "HOLDING" | "HELD" | "WAITING" | "INTERRUPTED";

export type Severity = "HINT" | "WARNING" | "ERROR" | "EMERGENCY";

export type Reaction = "SHOW" | "FEED_HOLD" | "AXIS_STOP" | "EMERGENCY_STOP";

export type DriveMode = "FOLLOWING" | "BRAKING" | "HELD" | "RETURNING" | "OFF" | "HOMING";

/** Lengths in mm, angles in degrees, feeds in mm/min, spindle speeds in 1/min, as in idl/channel.idl. */
export interface ChannelState {
  channel: number;
  name: string;
  /** interpolation cycle this was true at */
  cycle: number;
  mode: Mode;
  state: RunState;
  /** selected program */
  program: string;
  program_revision: number;
  /** line being executed, from 1 */
  line: number;
  /** lines of the selected program */
  lines_total: number;
  /** executed part of the program, 0..1, by bytes */
  progress: number;
  /** active G codes, one of each group */
  modal: string[];
  /** mm/min along the path now */
  feed: number;
  /** F in mm/min */
  programmed_feed: number;
  /** S in 1/min */
  spindle_programmed: number;
  /** 0..1.5 */
  feed_override: number;
  /** 0..1 */
  rapid_override: number;
  /** 0.5..1.5 */
  spindle_override: number;
  /** tool in the spindle */
  tool: number;
  /** active H */
  length_offset: number;
  /** mm */
  tool_length: number;
  /** 0 = G54 .. 5 = G59 */
  work_offset: number;
  rtcp: boolean;
  single_block: boolean;
  optional_stop: boolean;
  /** logical axis number of each of the channel's axes */
  axes: number[];
  /** their letters in the same order */
  letters: string;
  /** mm, deg: machine coordinates */
  machine: number[];
  /** mm, deg: tool tip, in the coordinates of the block being executed */
  workpiece: number[];
  /** mm, deg */
  distance_to_go: number[];
  /** counts resets; parameters with activation Reset take effect at each */
  reset_count: number;
  /** parameter revision in use */
  revision: number;
  /** cycles written and not yet executed */
  frames_ahead: number;
  /** every axis has its reference */
  homed: boolean;
  /** parameter 04c914 takes the place of programmed feeds */
  dry_run: boolean;
  /** M S T are passed over but for those of the program's flow */
  auxiliary_lock: boolean;
  /** 1 for each locked axis: it stays at rest while the program runs */
  locked: number[];
  /** levels 1..9 that are left out: bit 0 is level 1 */
  block_skip: number;
  /** the path is executed backwards */
  retracing: boolean;
  /** the program is held and the axes are moved by hand or MDI meanwhile */
  suspended: boolean;
  /** counts of the handwheel are added to the path */
  handwheel_offset_on: boolean;
  /** mm, deg: of each axis in machine coordinates */
  handwheel_offset: number[];
  /** line in which the control was switched off in the program, 0 = none */
  restart_line: number;
  /** the drives were switched off in the program: only a reset helps */
  needs_reset: boolean;
  /** what the channel waits for or does besides the program, empty = nothing */
  detail: string;
}

/** One axis of a channel: the channel's coordinates, and what the drive reports of the axis once it has. */
export interface AxisPosition {
  /** X Y Z A B C U V W */
  letter: string;
  /** Logical axis number */
  axis: number;
  /** mm or deg, machine coordinates */
  machine?: number;
  /** mm or deg, tool tip */
  workpiece?: number;
  /** mm or deg */
  distance_to_go?: number;
}

/** The state of one channel, with a row for each axis. */
export type ChannelWithPositions = ChannelState & { positions: AxisPosition[]; };

/** An active alarm. */
export interface Alarm {
  /** who raised it */
  instance: number;
  /** docs/alarms.md */
  number: number;
  /** axis, channel or service it is about, 0 when none */
  part: number;
  severity: Severity;
  reaction: Reaction;
  /** service name */
  source: string;
  text: string;
  /** stream cycle it was raised at */
  cycle: number;
  occurrences: number;
  /** When the gateway saw it first, ISO 8601 */
  since: string;
}

/** What is known of one service: its heartbeat, else its announcement, else what the launcher expects. */
export interface Service {
  /** e.g. kinematics */
  service: string;
  /** Number of the replica */
  replica: number;
  /** fastdds or cyclonedds */
  vendor: string;
  host: string;
  pid: number;
  lifecycle: "UNCONFIGURED" | "INACTIVE" | "ACTIVE" | "FAULT" | "ABSENT";
  /** What it waits for, or what is wrong */
  detail: string;
  frames_per_second: number;
  frames_lost: number;
  /** s */
  uptime: number;
  /** Parameter revision in use, 0 = none yet */
  revision: number;
  /** Of replicas of a stage */
  in_step: boolean;
  alive: boolean;
  /** The launcher's list has it */
  expected: boolean;
  restarts: number;
  /** Hash of its contract */
  contract: string;
  contract_match: boolean;
}

/** One logical axis at the newest executed cycle. */
export interface Axis {
  /** mm or deg */
  commanded: number;
  /** mm or deg: encoder */
  actual: number;
  /** mm or deg */
  following_error: number;
  /** Largest following error, by magnitude, since the message before */
  following_peak: number;
  /** mm or deg, now */
  position: number;
  /** mm/s or deg/s */
  velocity: number;
  /** Fraction of the rated torque */
  torque: number;
  enabled: boolean;
}

export interface ClusterState {
  domain: number;
  machine: string;
  ready: boolean;
  virtual_time: boolean;
  /** Cycles the channel may run ahead of the drive */
  lead: number;
}

export interface DriveState {
  /** Cycles executed */
  executed: number;
  /** Periods, holds included */
  tick: number;
  mode: DriveMode;
  /** Periods without a setpoint */
  starved: number;
  /** 1/min */
  spindle_speed: number[];
}

export interface PlcState {
  emergency_stop: boolean;
  feed_hold: boolean;
  coolant: number[];
  /** 1/min commanded */
  spindle_speed: number[];
}

/** Actual positions since the message before: one row per sample, one column per logical axis of `axes`. */
export interface Trace {
  /** Cycle of the first row */
  first: number;
  /** Cycles from the first row to each row: rows that are the same as the one before are left out, and of too many only every n-th is sent */
  since: number[];
  /** Logical axis number of each column */
  axes: number[];
  rows: number[][];
}

export interface Revisions {
  parameters?: number;
  /** Values that wait for reset or restart */
  pending?: number;
  tools?: number;
  work_offsets?: number;
  programs?: number;
}

/** The state of the cluster as the stream carries it; services by instance, channels and axes by number. */
export interface MachineState {
  cluster?: ClusterState;
  services: Record<string, Service>;
  alarms: Record<string, Alarm>;
  channels: Record<string, ChannelState>;
  axes: Record<string, Axis>;
  drive?: DriveState;
  plc?: PlcState;
  trace?: Trace;
  revisions: Revisions;
  operating?: Operating;
}

export interface Parameter {
  /** Number */
  number: number;
  /** Name */
  name: string;
  /** Unit */
  unit: string;
  /** integer, real or text */
  type: string;
  /** Lower limit */
  minimum?: number;
  /** Upper limit */
  maximum?: number;
  /** Default */
  default?: number | string;
  /** Active value */
  value: number | string;
  /** save, reset or restart */
  activation: string;
  /** Who may change it */
  access: string;
  /** A stored value waits for its activation */
  pending: boolean;
  /** The stored value that waits */
  pending_value?: number | string;
  /** What it does */
  help: string;
  /** Class */
  group: string;
}

export interface Tool {
  number: number;
  /** mm, spindle face to tip */
  length: number;
  /** mm, added */
  length_wear: number;
  /** mm */
  radius: number;
  /** mm, added */
  radius_wear: number;
  name: string;
}

export interface ToolTable {
  /** 0 */
  set: number;
  revision: number;
  /** ascending by number */
  tools: Tool[];
}

export interface WorkOffset {
  channel: number;
  /** 0 = G54 .. 5 = G59 */
  index: number;
  /** X Y Z A B C U V W, mm and deg, machine coordinates of the workpiece zero */
  values: number[];
}

export interface WorkOffsets {
  /** 0 */
  set: number;
  revision: number;
  offsets: WorkOffset[];
}

export interface ProgramEntry {
  name: string;
  /** counts changes of this program */
  revision: number;
  /** bytes */
  size: number;
  /** of the whole text */
  crc32: number;
  lines: number;
}

export interface ProgramList {
  /** 0 */
  set: number;
  /** counts changes of the store */
  revision: number;
  /** ascending by name */
  programs: ProgramEntry[];
}

export interface Variables {
  channel: number;
  /** ascending: 50..199, 500..999, 50000..54999 */
  numbers: number[];
  /** of each */
  values: number[];
}

export interface PlcImage {
  plc: number;
  /** 1 ms scans since the start */
  scan: number;
  x: number[];
  y: number[];
  f: number[];
  g: number[];
  r: number[];
  b: number[];
  w: number[];
  d: number[];
  t: number[];
  c: number[];
  k: number[];
  p: number[];
}

export interface Stored {
  accepted: true;
  program: ProgramEntry;
}

/** Where and why the program cannot be executed. */
export interface ProgramError {
  /** From 1, in the text */
  line: number;
  /** In characters from 1; 0 = the whole line */
  column: number;
  /** Alarm number, docs/alarms.md */
  number: number;
  text: string;
  /** Name of the subprogram that it is in; `line` is then that of the call */
  program?: string;
  /** Line of the subprogram */
  program_line?: number;
}

/** Tool tip on the part: point i is reached by a move of line[i], the first one is the start. Machine coordinates less G54, rotary tables at zero. */
export interface ProgramPath {
  /** mm */
  x: number[];
  /** mm */
  y: number[];
  /** mm */
  z: number[];
  /** Line of the text */
  line: number[];
  /** Of rapid traverse */
  rapid: boolean[];
  /** False: only the first points are here */
  whole: boolean;
}

/** What a program would do from the reference position with the active parameters, tools and offsets. */
export interface ProgramCheck {
  /** False: the time for a check was over before the end, and there was no error until then */
  complete: boolean;
  /** Executed blocks */
  blocks: number;
  /** Rapids, lines and arcs */
  moves: number;
  error?: ProgramError;
  path: ProgramPath;
}

export interface RecordingList {
  recordings: RecordingEntry[];
  /** Name of the one that is being recorded; empty = none */
  recording: string;
  /** Bytes that are free on the disk */
  free: number;
}

export interface RecordingEntry {
  name: string;
  /** Bytes */
  size: number;
  /** ISO 8601, UTC */
  modified: string;
  etag: string;
  /** It is being recorded */
  recording: boolean;
}

export interface RecordingAccepted {
  accepted: boolean;
  name: string;
}

export interface Session {
  /** Users must log in (auth in machine.yaml) */
  auth: boolean;
  name: string;
  role: "" | "operator" | "setter" | "builder" | "administrator";
}

export interface Identity {
  name: string;
  role: "operator" | "setter" | "builder" | "administrator";
}

/** Problem details (RFC 9457). */
export interface Problem {
  /** about:blank */
  type: string;
  /** Of the status */
  title: string;
  status: number;
  /** What happened, and why */
  detail: string;
  /** Of the request, when one is wrong */
  field?: string;
}

/** A browser, a program or the command line. */
export interface OperatingStation {
  /** The same for the same station */
  number: number;
  name: string;
}

/** Which station operates, and which one asks for the right; absent where there is none. */
export interface Operating {
  holder?: OperatingStation;
  asking?: OperatingStation;
}

export interface OperatingRight {
  /** One station operates; otherwise every one does */
  one: boolean;
  /** Of the station that asks */
  number: number;
  /** Without the consent of the holder */
  may_take_over: boolean;
  mine: boolean;
  holder: OperatingStation | null;
  asking: OperatingStation | null;
}

/** A variable of the PLC's programs, or a register. */
export interface PlcVariable {
  /** main.n, main.list[2], %G300 */
  path: string;
  type: string;
  unit?: string;
  retained: boolean;
  /** Values of an enumeration */
  names?: Record<string, number>;
}

export interface PlcVariableList {
  /** That match */
  total: number;
  offset: number;
  variables: PlcVariable[];
}

export interface PlcForcedValue {
  path: string;
  type: string;
  /** a literal of the language */
  value: string;
  /** also after the next start of the cluster */
  permanent: boolean;
}

export interface PlcForces {
  values: PlcForcedValue[];
}

export interface PlcTask {
  /** scan, simulation, fast or main */
  name: string;
  /** Scans in which it ran since the programs began */
  runs: number;
  last_us: number;
  worst_us: number;
  budget_us: number;
  /** Of the last scan; of an instruction list its instructions */
  statements: number;
  /** The most of one scan */
  most_statements: number;
  /** Of one scan; 0: none */
  statement_budget: number;
}

export interface PlcTasks {
  tasks: PlcTask[];
}

export type PlcLoadPhase = "NO_LOAD" | "WRITING" | "COMPILING" | "WITH_ERRORS" | "COMPILED" | "COMPARING";

export interface PlcPrograms {
  /** Of the sources */
  crc32: number;
  /** They are those of the machine's directory */
  delivered: boolean;
  /** Online changes since the delivered ones were loaded */
  changes: number;
  phase: PlcLoadPhase;
  files: { name: string; bytes: number; }[];
}

export interface PlcTraceRow {
  /** Of the PLC, since its start */
  time_ms: number;
  /** Of the drive */
  tick: number;
  /** Literals of the language */
  values: string[];
}

export interface PlcTraceRows {
  /** Number of the first row */
  from: number;
  total: number;
  /** No row is to come */
  complete: boolean;
  variables: PlcVariable[];
  rows: PlcTraceRow[];
}

export interface PlcLoad {
  phase: PlcLoadPhase;
  /** Scans */
  compared: number;
  /** Registers and variables that have differed */
  differences: number;
  /** Errors, warnings, what is not kept, what differs */
  messages: string[];
}

/** Bodies of POST /api/channels/{channel}/..., by the last part of the path. */
export interface ChannelCommands {
  "cycle-start": Record<string, never>;
  "feed-hold": Record<string, never>;
  "reset": Record<string, never>;
  "select": { program: string; };
  "mode": { mode: Mode; };
  "mdi": { line: string; };
  "override": { kind: "feed"; value: number; } | { kind: "rapid"; value: number; } | { kind: "spindle"; value: number; };
  "override-step": { kind: "feed"; step: number; } | { kind: "rapid"; step: number; } | { kind: "spindle"; step: number; };
  "single-block": { on: boolean; };
  "optional-stop": { on: boolean; };
  "start-from-line": { line: number; };
  "dry-run": { on: boolean; };
  "axis-lock": { axes: (string | number)[]; };
  "auxiliary-lock": { on: boolean; };
  "block-skip": { levels: number[]; };
  "retrace": { on: boolean; };
  "jog": { axis: string | number; speed: number; increment?: number; press?: number; };
  "jog-renew": { press: number; };
  "jog-stop": { axis: string | number; };
  "reference": { axis: string | number; };
  "handwheel": { axis: string | number; counts: number; increment: number; };
  "handwheel-offset": { on: boolean; };
}
