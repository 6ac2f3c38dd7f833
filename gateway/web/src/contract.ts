// SPDX-License-Identifier: Apache-2.0
// Generated from gateway/openapi.json by tools/generate_api.py.
export interface Accepted {
  accepted: true;
  /** Interpolation cycle it was applied at */
  cycle?: number;
}

export interface Repeated {
  accepted: true;
  /** What is repeated, until when, and what to do meanwhile; for display */
  reason: string;
}

export type Mode = "AUTO" | "MDI" | "JOG" | "REF";

export type RunState = "IDLE" | "RUNNING" | "HOLDING" | "HELD" | "WAITING" | "INTERRUPTED";

export type Severity = "HINT" | "WARNING" | "ERROR" | "EMERGENCY";

export type Reaction = "SHOW" | "FEED_HOLD" | "AXIS_STOP" | "EMERGENCY_STOP";

export type DriveMode = "FOLLOWING" | "BRAKING" | "HELD" | "RETURNING" | "OFF" | "HOMING";

export type SpindleCondition = "SPINDLE_STOPPED" | "SPINDLE_ACCELERATING" | "SPINDLE_AT_SPEED" | "SPINDLE_POSITIONING" | "SPINDLE_ORIENTED" | "SPINDLE_FOLLOWS_PATH" | "SPINDLE_SYNCHRONIZING" | "SPINDLE_SYNCHRONIZED";

export interface SpindleShown {
  condition: SpindleCondition;
  /** Its index mark was passed since the start: the angle counts from it */
  homed: boolean;
  /** deg, clockwise, 0..360 */
  angle: number;
  /** From 1; 0 = the spindle has no gears */
  gear: number;
  /** 1/min, signed: the speed its control is given now */
  reference: number;
  /** Number of the spindle it follows; -1 = none */
  master: number;
  /** deg, of a spindle that follows: where it should be less where it is */
  synchronization_error: number;
  /** 1/min, of the integral action of a spindle that follows */
  correction: number;
}

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
  /** of the program: being executed, from 1 */
  line: number;
  /** lines of the selected program */
  lines_total: number;
  /** G codes of the block being executed, one of each group */
  modal: string[];
  /** mm/min along the path now */
  feed: number;
  /** F in mm/min, of the block being executed */
  programmed_feed: number;
  /** S in 1/min, with G96 in m/min */
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
  /** machined since it was set: ends of programs by M2 and M30, tests left out */
  parts: number;
  /** counts resets; parameters with activation Reset take effect at each */
  reset_count: number;
  /** parameter revision in use */
  revision: number;
  /** cycles written and not yet executed */
  cycles_ahead: number;
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

/** An axis with its place when every axis is at zero; mm, machine coordinates. */
export interface CarryingAxis {
  /** X, Y, Z, A, B, C, U, V or W */
  axis: string;
  rotary: boolean;
  /** Unit vector in which it moves, or about which it turns, what it carries */
  direction: number[];
  /** Of a rotary axis: a point of it */
  point: number[];
}

/** A convex body; lengths in mm. */
export interface MachineBody {
  name: string;
  side: "tool" | "workpiece";
  /** So many axes of that side carry it, counted from the base; 0: it is on the base */
  depth: number;
  /** It goes when another tool is put into the spindle */
  tool: boolean;
  /** Of its centre, of a hull: of its origin, with every axis at zero; machine coordinates */
  position: number[];
  /** Matrix of its directions, row after row */
  rotation: number[];
  /** The axis of a cylinder is Z */
  shape: "box" | "cylinder" | "sphere" | "hull";
  /** box: lengths in X, Y and Z; cylinder: diameter and height; sphere: diameter; hull: nothing */
  size: number[];
  /** Of a hull */
  points?: number[][];
}

export interface MachineBodies {
  channel: number;
  /** The machine has no bodies.yaml */
  derived: boolean;
  /** Which axes carry the workpiece and which the tool: [w C' A' b X Y Z (S) t] */
  structure: string;
  /** From the base outwards */
  workpiece_side: CarryingAxis[];
  /** From the base outwards */
  tool_side: CarryingAxis[];
  bodies: MachineBody[];
}

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

/** An alarm, and when it was raised and cleared. */
export interface PastAlarm {
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
  /** When the gateway heard of it, ISO 8601 */
  raised: string;
  /** ISO 8601; not there while it is active */
  cleared?: string;
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
  messages_per_second: number;
  cycles_lost: number;
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
  /** Its name */
  machine: string;
  /** Of the machine, for people */
  title: string;
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
  /** In the order of their numbers */
  spindles?: SpindleShown[];
}

export interface ChannelControl {
  /** no cycle start and no MDI line; what runs continues */
  start_inhibit: boolean;
  /** no jog, handwheel and reference return; what moves is stopped */
  manual_inhibit: boolean;
  /** the overrides below are in force, and orders to change them are refused */
  sets_overrides: boolean;
  /** 0..1.5 */
  feed_override: number;
  /** 0..1 */
  rapid_override: number;
  /** 0.5..1.5 */
  spindle_override: number;
  /** of the inhibits, for the operator; empty = the programs give none */
  reason: string;
  /** spindle and axis of a rigid tap stop together; they continue when it falls */
  tap_stop: boolean;
}

export interface PlcState {
  /** What the PLC inhibits, by the number of the channel; those that are not in it have no inhibit */
  channels?: ChannelControl[];
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

/** The time of the program of a channel since its start, holds included; the last one when none runs. */
export interface RunTime {
  /** Periods of the drive, as tick of DriveState */
  ticks: number;
  /** It ran before the gateway did: the time is longer */
  partial: boolean;
}

/** The state of the cluster as the stream carries it; services by instance, channels and axes by number. */
export interface MachineState {
  cluster?: ClusterState;
  services: Record<string, Service>;
  alarms: Record<string, Alarm>;
  channels: Record<string, ChannelState>;
  axes: Record<string, Axis>;
  /** How long programs have run, by the number of the channel */
  run_times?: Record<string, RunTime>;
  drive?: DriveState;
  plc?: PlcState;
  trace?: Trace;
  revisions: Revisions;
  operating?: Operating;
  measurement?: MeasurementState;
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

export type LifeUnit = "MINUTES" | "PIECES";

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
  /** for display: end mill, drill */
  type: string;
  /** in life_unit, as it was entered: the control does not count it */
  life_used: number;
  /** in life_unit, 0 = not limited */
  life_limit: number;
  life_unit: LifeUnit;
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
  /** 0 = G54 .. 5 = G59, 6 = G54.1 P1 .. 53 = G54.1 P48, 54 = external, added to all others, 55 .. 61 = setting errors G54.4 P1 .. P7 */
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
  /** of who stored it: what the program may change, as in ParameterRequest */
  role: number;
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
  dialect: ProgramDialect;
  error?: ProgramError;
  path: ProgramPath;
}

/** In which a program text is written: its head says so, else its name, else parameter 04c959. */
export type ProgramDialect = "iso" | "num" | "linuxcnc" | "haas";

/** Tool tip on the part: point i is reached in line[i], the first one is the start. Machine coordinates less G54, rotary tables at zero. Between the points the path is within the tolerance of straight lines. */
export interface PlannedPath {
  /** mm */
  x: number[];
  /** mm */
  y: number[];
  /** mm */
  z: number[];
  /** Line of the program */
  line: number[];
  /** In rapid traverse */
  rapid: boolean[];
  /** From the start */
  seconds: number[];
  /** mm */
  tolerance: number;
}

/** What a stored program will do, at feed override 100 %. */
export interface ProgramPlan {
  /** Name in the store */
  program: string;
  revision: number;
  channel: number;
  /** False: the time for planning was over before the end; seconds and path are those until there */
  complete: boolean;
  /** Time of the motion, dwells included */
  seconds: number;
  /** Rapids, lines, arcs, dwells and what is executed between them */
  moves: number;
  /** Why it cannot be executed further: line and cause */
  alarm?: string;
  dialect: ProgramDialect;
  /** When the program comes to which line, in the order of execution; of more than 20000 the shortest stretches are left out */
  lines: { line: number[]; begin: number[]; };
  path: PlannedPath;
}

export interface RecordingList {
  recordings: RecordingEntry[];
  /** Name of the one that is being recorded; empty = none */
  recording: string;
  /** Why the newest recording since the start of the gateway is not complete, with its name; empty = nothing is missing */
  problem: string;
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
  /** Of the last scan */
  statements: number;
  /** The most of one scan */
  most_statements: number;
  /** Of one scan; 0: none */
  statement_budget: number;
}

export interface PlcTasks {
  tasks: PlcTask[];
}

export interface PlcUse {
  file: string;
  /** from 1 */
  line: number;
  /** from 1 */
  column: number;
  reads: boolean;
  writes: boolean;
  /** of a function block */
  calls: boolean;
  /** of a diagram: POU, network and element */
  element: string;
}

export interface PlcUses {
  total: number;
  offset: number;
  uses: PlcUse[];
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

export type MeasurementPhase = "NOTHING" | "PLANNING" | "REPEATABILITY" | "MEASURING" | "RETRACTING" | "ESTIMATING" | "WAITING" | "WRITING" | "STOPPING" | "INTERRUPTED" | "FINISHED";

export interface MeasurementState {
  /** 0 */
  set: number;
  /** counts the measurements, 0 = there was none */
  measurement: number;
  channel: number;
  phase: MeasurementPhase;
  /** started it */
  who: string;
  /** of the start, ISO 8601, UTC */
  time: string;
  /** planned */
  poses: number;
  /** poses with all their touches */
  complete: number;
  /** being planned or measured, as "A-60 C0" */
  pose: string;
  /** executed part of planning and measuring, 0..1 */
  progress: number;
  /** mm, range of five touches; negative = not measured yet */
  repeatability: number;
  /** what it waits for or has done, one line */
  detail: string;
  /** INTERRUPTED: number of the alarm that is the cause, 0 = none */
  alarm: number;
  /** INTERRUPTED: phase, cause and what is kept, one line */
  error: string;
  /** WAITING: a vector changes by more than its tolerance; empty = none does */
  tolerance_alarm: string;
  /** such a result cannot be confirmed */
  tolerance_needs_reset: boolean;
  may_continue: boolean;
  may_confirm: boolean;
  /** FINISHED: parameters were written, active after a reset of the channel */
  written: boolean;
}

export interface MeasurementPose {
  /** deg, A B C U V W */
  angles: number[];
  /** mm, X Y Z of each touch, as latched */
  touches: number[];
  /** mm, measured: machine coordinates of the ball in the sphere; empty = no result yet */
  centre: number[];
  /** mm, expected less measured centre */
  difference: number[];
  /** mm, measured less computed centre with the new vectors */
  residual: number[];
  /** mm, measured */
  diameter: number;
}

export interface MeasurementVector {
  /** the rotary axis that the vector places */
  axis: string;
  /** mm, offset with correction */
  before: number[];
  /** mm */
  after: number[];
  /** mm, 95 % */
  uncertainty: number[];
  /** unit vector, ideal */
  direction_before: number[];
  /** unit vector, measured */
  direction_after: number[];
}

export interface MeasurementChange {
  /** of the parameter */
  number: number;
  /** in the catalogue's unit */
  before: number;
  after: number;
}

export interface MeasurementResult {
  /** 0 */
  set: number;
  measurement: number;
  /** complete ones, in the order of the plan */
  poses: MeasurementPose[];
  /** what follows is there */
  valid: boolean;
  vectors: MeasurementVector[];
  /** parameters that a confirmation writes */
  changes: MeasurementChange[];
  /** mm, of an offset vector */
  largest_change: number;
  /** mm, standard deviation of a touch by the residuals */
  touch_deviation: number;
  protocol: string;
}

export interface Measurement {
  state: MeasurementState;
  result?: MeasurementResult;
}

export interface MeasurementAccepted {
  accepted: true;
  /** Its number */
  measurement: number;
}

/** How one rotary axis is measured. */
export interface MeasurementRange {
  /** Below end_deg; both in the travel */
  start_deg: number;
  end_deg: number;
  /** Of this axis */
  points: number;
  /** Of the other rotary axis */
  other_deg: number;
  /** Of the first touch on the equator */
  touch_start_deg: number;
  /** What becomes of the component along the axis */
  normalization?: number;
  /** For normalization 1 to 3 */
  normalized_value_mm?: number;
}

/** Inputs of a measurement of the kinematics, by the keys of docs/calibration.md. */
export interface MeasurementInputs {
  plane: "G17" | "G18" | "G19" | "active";
  transformation?: string;
  mode: "measure_only" | "correct" | "only_correct";
  calibrate_probe: boolean;
  positioning: "paraxial" | "circular";
  reference: "without" | "measure" | "adapt";
  /** Work offset of the reference */
  zero_offset_mm: number[];
  sphere: { centre_mm: number[]; diameter_mm: number; shaft?: number[]; shaft_diameter_mm?: number; };
  probe: { length_mm: number; length_uncertainty_mm: number; ball_diameter_mm: number; on_m: number; off_m: number; };
  /** Before and after the expected touch */
  measuring_path_mm: number;
  /** Largest distance of a centre from the expected one */
  confidence_range_mm: number;
  /** By their letters */
  axes: Record<string, MeasurementRange>;
  /** Of both axes together in addition */
  further_poses: number;
  /** Largest change of an offset vector */
  vector_tolerance_mm?: number;
  tolerance_alarm: "acknowledge" | "reset";
  directions: "report" | "write";
  settings: { touches: number; diameter_tolerance_mm: number; least_triangle_angle_deg: number; least_swept_angle_deg: number; rotary_feed_deg_per_min: number; circle_feed_mm_per_min: number; positioning_feed_mm_per_min: number; first_touch_feed_mm_per_min: number; measuring_feed_mm_per_min: number; repeatability_mm: number; transformation_active: boolean; };
}

export interface MeasurementOffer {
  channel: number;
  inputs: MeasurementInputs;
  /** Of each rotary axis that has a travel, by its letter: lowest and highest angle */
  travel: Record<string, number[]>;
}

/** The last calibration, before and after its change. */
export interface Calibration {
  /** In the journal */
  time: string;
  /** In the journal */
  who: string;
  changes: MeasurementChange[];
  /** POST: values that wait for a reset or a restart */
  pending?: number;
}

export interface ManualReading {
  /** Of the field in readings */
  name: string;
  about: string;
}

export interface ManualStep {
  /** Positions of the rotary axes */
  at: string;
  /** Instrument */
  use: string;
  /** What to touch and how */
  do: string;
  readings: ManualReading[];
}

export interface ManualVector {
  /** Letter of the rotary axis */
  axis: string;
  /** X, Y, Z */
  offset_mm: number[];
}

export interface ManualGuide {
  channel: number;
  kind: "ac-table" | "bc-head" | "ac-head" | "hybrid";
  title: string;
  /** Before the calibration */
  checks: string[];
  steps: ManualStep[];
  /** Of the instruments */
  values: ManualReading[];
  /** Names that may be absent */
  optional: string[];
  /** Of the check, nine */
  poses: string[];
  /** Active ones, with their corrections */
  vectors: ManualVector[];
}

export interface ManualChange {
  /** of the parameter */
  number: number;
  name: string;
  /** mm */
  after: number;
}

export interface ManualAcceptance {
  name: string;
  value_mm: number;
  limit_mm: number;
}

export interface ManualEvaluation {
  before: ManualVector[];
  after: ManualVector[];
  changes: ManualChange[];
  /** Displacements: all are within their limits */
  accepted?: boolean;
  /** Displacements */
  acceptance?: ManualAcceptance[];
  /** Values that wait for a reset or a restart */
  pending: number;
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
  "parts": { parts: number; };
  "tool-in-spindle": { tool: number; };
}

/** What POST /api/channels/{channel}/override accepts as value, by the kind. */
export const overrideLimits = {
  feed: { minimum: 0, maximum: 1.5 },
  rapid: { minimum: 0, maximum: 1 },
  spindle: { minimum: 0.5, maximum: 1.5 },
};
