// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import {
  type Alarm, axisRows, canStart, type Channel, channelNumbers, emptyState, emptyStream, failingLine, inhibition, receive, recoverySteps,
  sortedAlarms,
} from "../src/state/model";

const channel = {
  channel: 0, mode: "AUTO", state: "IDLE", program: "A.NC", axes: [0, 1, 5], letters: "XYC",
  machine: [1, 2, 3], workpiece: [11, 12, 13], distance_to_go: [0, 0, 0.5],
} as unknown as Channel;

test("the first message is the whole state, the next ones change parts of it", () => {
  const first = receive(emptyStream, { sequence: 4, state: { channels: { "0": { feed: 10, line: 1 } } } })!;
  expect(first.state.alarms).toEqual({});
  const second = receive(first, { sequence: 5, since: 4, changes: { channels: { "0": { feed: 20 } } } })!;
  expect(second.state.channels["0"]).toEqual({ feed: 20, line: 1 });
  expect(second.sequence).toBe(5);
});

test("a change of another state than ours asks for a new connection", () => {
  const first = receive(emptyStream, { sequence: 4, state: {} })!;
  expect(receive(first, { sequence: 9, since: 8, changes: {} })).toBeNull();
});

test("an alarm that is over disappears by a null", () => {
  const first = receive(emptyStream, { sequence: 1, state: { alarms: { "1/2/3": { number: 2 } } } })!;
  const second = receive(first, { sequence: 2, since: 1, changes: { alarms: { "1/2/3": null } } })!;
  expect(second.state.alarms).toEqual({});
});

test("channels are in the order of their numbers, not of their names", () => {
  expect(channelNumbers({ ...emptyState, channels: { "10": channel, "2": channel } })).toEqual([2, 10]);
});

test("alarms: the worst first, then the oldest", () => {
  const alarm = (number: number, severity: string, since: string) => ({ number, severity, since, instance: 1, part: 0 }) as Alarm;
  const alarms = {
    a: alarm(1, "WARNING", "2026-01-01T00:00:00Z"),
    b: alarm(2, "ERROR", "2026-01-01T00:00:09Z"),
    c: alarm(3, "ERROR", "2026-01-01T00:00:01Z"),
  };
  expect(sortedAlarms({ ...emptyState, alarms }).map((a) => a.number)).toEqual([3, 2, 1]);
});

test("a row takes its following error from the drive's axis of that logical number and its unit from the letter", () => {
  const error = { following_error: 0.1, following_peak: 0.2 };
  const axes = { "5": { commanded: 3, actual: 2.9, ...error, position: 2.9, velocity: 0, torque: -0.3, enabled: true } };
  const rows = axisRows({ ...emptyState, axes }, channel);
  expect(rows.map((row) => row.unit)).toEqual(["mm", "mm", "deg"]);
  expect(rows[2]).toMatchObject({ letter: "C", machine: 3, workpiece: 13, distanceToGo: 0.5, followingError: 0.1 });
  expect(rows[0]!.followingError).toBeUndefined();
  expect(rows[0]!.load).toBeUndefined();
  expect(rows[2]!.load).toBe(0.3);
});

test("an axis has no reference while its drive says so, and the channel does not know of a newer one", () => {
  const alarm = (number: number, part: number) => ({ number, part }) as Alarm;
  const state = { ...emptyState, alarms: { a: alarm(115, 5), b: alarm(115, 7), c: alarm(116, 0) } };
  const homed = (whole: boolean) => axisRows(state, { ...channel, homed: whole }).map((row) => row.homed);
  expect(homed(false)).toEqual([true, true, false]);
  expect(homed(true)).toEqual([true, true, true]);
});

test("cycle start: not without a program, not while running, not under an emergency stop, but always to go on", () => {
  const plc = (emergency_stop: boolean) => ({
    ...emptyState, plc: { emergency_stop, feed_hold: false, coolant: [], spindle_speed: [] },
  });
  expect(canStart(plc(false), channel)).toBe(true);
  expect(canStart(plc(true), channel)).toBe(false);
  const inhibited = (start_inhibit: boolean, manual_inhibit: boolean, reason: string) => {
    const state = plc(false);
    const control = { start_inhibit, manual_inhibit, sets_overrides: false, feed_override: 1, rapid_override: 1, spindle_override: 1, reason, tap_stop: false };
    return { ...state, plc: { ...state.plc, channels: [control] } };
  };
  expect(canStart(inhibited(true, false, "the door is open"), channel)).toBe(false);
  expect(canStart(inhibited(false, true, "the door is open"), channel)).toBe(true);
  expect(inhibition(inhibited(true, false, "the door is open"), channel, "start", "PLC")).toBe("the door is open");
  expect(inhibition(inhibited(true, false, "the door is open"), channel, "manual", "PLC")).toBe("");
  expect(inhibition(inhibited(false, true, ""), channel, "manual", "PLC")).toBe("PLC");
  expect(canStart(emptyState, { ...channel, program: "" })).toBe(false);
  expect(canStart(emptyState, { ...channel, state: "RUNNING" })).toBe(false);
  expect(canStart(emptyState, { ...channel, mode: "JOG" })).toBe(false);
  expect(canStart(emptyState, { ...channel, mode: "MDI" })).toBe(false);
  expect(canStart(emptyState, { ...channel, mode: "MDI", state: "HELD" })).toBe(true);
  expect(canStart(emptyState, { ...channel, mode: "JOG", state: "HELD" })).toBe(true);
});

test("the way out of a stop: the emergency stop, then alarms that hold, then channels that need a reset", () => {
  const alarm = (reaction: string) => ({ number: 110, severity: "ERROR", reaction, since: "", instance: 1, part: 0 }) as Alarm;
  const stopped = {
    ...emptyState, plc: { emergency_stop: true, feed_hold: false, coolant: [], spindle_speed: [] },
    alarms: { a: alarm("AXIS_STOP") }, channels: { "0": { ...channel, needs_reset: true }, "1": { ...channel, name: "Loader" } },
  };
  expect(recoverySteps(stopped).map((step) => [step.kind, step.channel?.channel])).toEqual(
    [["release", undefined], ["alarms", undefined], ["channel", 0]]);
  expect(recoverySteps({ ...emptyState, alarms: { a: alarm("SHOW") }, channels: { "0": channel } })).toEqual([]);
});

test("cycle start is dark while anything refuses it: an alarm that holds, axes without power, a reset that is due", () => {
  expect(canStart(emptyState, { ...channel, needs_reset: true })).toBe(false);
  const alarm = { number: 110, severity: "ERROR", reaction: "FEED_HOLD", since: "", instance: 1, part: 0 } as Alarm;
  expect(canStart({ ...emptyState, alarms: { a: alarm } }, channel)).toBe(false);
  expect(canStart({ ...emptyState, alarms: { a: { ...alarm, reaction: "SHOW" } } }, channel)).toBe(true);
  const axis = { commanded: 0, actual: 0, following_error: 0, following_peak: 0, position: 0, velocity: 0, torque: 0, enabled: false };
  expect(canStart({ ...emptyState, axes: { "5": axis } }, channel)).toBe(false);
});

test("the failing line is the one that the channel's alarm names in its own program", () => {
  const alarm = (text: string, part = 0) =>
    ({ number: 1107, severity: "ERROR", reaction: "SHOW", source: "channel", text, part, since: "", instance: 1 }) as Alarm;
  const line = (text: string, part = 0) => failingLine({ ...emptyState, alarms: { a: alarm(text, part) } }, channel);
  expect(line("A.NC:12:5: word has no meaning in this block: X0")).toBe(12);
  expect(line("O0012:3:1: word has no meaning")).toBe(0);
  expect(line("A.NC:12:5: word", 1)).toBe(0);
  expect(line("MDI:1:1: word")).toBe(0);
});
