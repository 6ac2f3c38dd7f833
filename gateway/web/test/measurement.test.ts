// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { MeasurementInputs, MeasurementPhase, MeasurementPose, MeasurementResult, MeasurementState } from "../src/contract";
import { faultsOf, fieldsOf, inputsOf, refusalOf, yamlOf } from "../src/measurement/inputs";
import { givesUp, isUnderWay, phaseText, poseNumber, possibleOrders } from "../src/measurement/progress";
import { inclination, isOf, largest, lettersOf, micrometres, plotRange, poseName, vectorRows } from "../src/measurement/result";
import { languages } from "../src/text/texts";

const range = (start_deg: number, end_deg: number) => ({ start_deg, end_deg, points: 8, other_deg: 5, touch_start_deg: 0 });
const inputs = {
  plane: "active", mode: "measure_only", calibrate_probe: false,
  sphere: { centre_mm: [60, 40, -360.5], diameter_mm: 25, shaft: [0, 0, -1] },
  probe: { length_mm: 60, ball_diameter_mm: 6 },
  axes: { A: range(-90, 30), C: range(0, 315) },
  settings: { touches: 10, transformation_active: false },
} as unknown as MeasurementInputs;
const travel = { A: [-120, 30] };

test("the fields show the inputs that the machine offers", () => {
  const fields = fieldsOf(inputs);
  expect(fields.sphere).toEqual(["60", "40", "-360.5"]);
  expect(fields.probeLength).toBe("60");
  expect(fields.axes).toEqual([{ letter: "A", start: "-90", end: "30", points: "8" }, { letter: "C", start: "0", end: "315", points: "8" }]);
  expect(faultsOf(fields, travel).size).toBe(0);
  expect(inputsOf(inputs, fields)).toEqual(inputs);
});

test("a machine that knows neither probe nor sphere leaves them to be typed", () => {
  const unknown = { ...inputs, probe: { ...inputs.probe, length_mm: 0 }, sphere: { ...inputs.sphere, centre_mm: [0, 0, 0] } };
  const fields = fieldsOf(unknown);
  expect([...fields.sphere, fields.probeLength]).toEqual(["", "", "", ""]);
  expect([...faultsOf(fields, travel).keys()]).toEqual(["X", "Y", "Z", "probe"]);
});

test("what is typed is in the inputs, and nothing else changes", () => {
  const fields = fieldsOf(inputs);
  const changed = inputsOf(inputs, { ...fields, mode: "correct", sphere: ["1,5", "\u22122", "3"], probeLength: "61.25", axes: [{ ...fields.axes[0]!, start: "-60", points: "3" }, fields.axes[1]!] });
  expect(changed).toEqual({
    ...inputs, mode: "correct", sphere: { ...inputs.sphere, centre_mm: [1.5, -2, 3] }, probe: { ...inputs.probe, length_mm: 61.25 },
    axes: { A: { ...inputs.axes.A, start_deg: -60, points: 3 }, C: inputs.axes.C },
  });
});

test("a field beyond its limits is named with what is wrong", () => {
  const fields = fieldsOf(inputs);
  const [a, c] = [fields.axes[0]!, fields.axes[1]!];
  const faults = (changed: Partial<typeof fields>) => Object.fromEntries(faultsOf({ ...fields, ...changed }, travel));
  expect(faults({ sphere: ["x", "100000", "100000.1"] })).toEqual({ X: "number", Z: "limits" });
  expect(faults({ probeLength: "0" })).toEqual({ probe: "limits" });
  expect(faults({ axes: [{ ...a, start: "-120", end: "30" }, c] })).toEqual({});
  expect(faults({ axes: [{ ...a, start: "-120.1", end: "31" }, c] })).toEqual({ "A.start": "limits", "A.end": "limits" });
  expect(faults({ axes: [{ ...a, start: "30", end: "30" }, c] })).toEqual({ "A.end": "order" });
  expect(faults({ axes: [{ ...a, points: "2" }, { ...c, points: "3.5" }] })).toEqual({ "A.points": "limits", "C.points": "whole" });
  expect(faults({ axes: [a, { ...c, end: "720" }] })).toEqual({});  // C has no travel
});

test("the YAML has a value in each line and maps by their indent", () => {
  expect(yamlOf(inputs).split("\n")).toEqual([
    "plane: active", "mode: measure_only", "calibrate_probe: false",
    "sphere:", "  centre_mm: [60, 40, -360.5]", "  diameter_mm: 25", "  shaft: [0, 0, -1]",
    "probe:", "  length_mm: 60", "  ball_diameter_mm: 6",
    "axes:", "  A:", "    start_deg: -90", "    end_deg: 30", "    points: 8", "    other_deg: 5", "    touch_start_deg: 0",
    "  C:", "    start_deg: 0", "    end_deg: 315", "    points: 8", "    other_deg: 5", "    touch_start_deg: 0",
    "settings:", "  touches: 10", "  transformation_active: false", "",
  ]);
});

test("a refusal names the line of the YAML or the axis", () => {
  expect(refusalOf("inputs:12:5: error: 2 is not within 3 .. 12")).toEqual({ text: "2 is not within 3 .. 12", line: 12, axis: "" });
  expect(refusalOf("inputs:1:1: error: axis A: start angle 5 deg")).toEqual({ text: "axis A: start angle 5 deg", line: 1, axis: "A" });
  expect(refusalOf("channel 0 is HELD with a program")).toEqual({ text: "channel 0 is HELD with a program", line: 0, axis: "" });
});

const state = (phase: MeasurementPhase, more: Partial<MeasurementState> = {}) =>
  ({ phase, measurement: 3, poses: 16, complete: 4, may_continue: false, may_confirm: false, ...more }) as MeasurementState;

test("only a measurement under way is aborted, and only another one is started or discarded", () => {
  const all = ["NOTHING", "PLANNING", "REPEATABILITY", "MEASURING", "RETRACTING", "ESTIMATING", "WAITING", "WRITING", "STOPPING", "INTERRUPTED", "FINISHED"] as const;
  const which = (order: "start" | "abort" | "discard") => all.filter((phase) => possibleOrders(state(phase))[order]);
  expect(which("abort")).toEqual(["PLANNING", "REPEATABILITY", "MEASURING", "RETRACTING", "ESTIMATING"]);
  expect(which("start")).toEqual(["NOTHING", "WAITING", "INTERRUPTED", "FINISHED"]);
  expect(all.filter((phase) => givesUp(state(phase)))).toEqual(["WAITING", "INTERRUPTED"]);
  expect(which("discard")).toEqual(["WAITING", "INTERRUPTED", "FINISHED"]);
  expect(all.filter(isUnderWay)).toEqual(all.filter((phase) => !possibleOrders(state(phase)).start));
  expect(possibleOrders(state("INTERRUPTED", { may_continue: true })).continue).toBe(true);
  expect(possibleOrders(state("WAITING", { may_confirm: true })).confirm).toBe(true);
  expect(new Set(all.map((phase) => phaseText(phase, languages.de))).size).toBe(all.length);
});

test("the pose under way is counted from one and never beyond the last", () => {
  expect(poseNumber(state("MEASURING"))).toBe(5);
  expect(poseNumber(state("MEASURING", { complete: 16 }))).toBe(16);
});

const pose = (a: number, c: number, residual: number[] = [], difference: number[] = []): MeasurementPose =>
  ({ angles: [a, 0, c, 0, 0, 0], touches: [], centre: [], difference, residual, diameter: 25 });
const result = (poses: MeasurementPose[], valid = true): MeasurementResult =>
  ({ set: 0, measurement: 3, poses, valid, vectors: [], changes: [], largest_change: 0, touch_deviation: 0, protocol: "" });

test("micrometres have their sign", () => {
  expect([0.0012, -0.0004, 0, -0.00001, 0.1].map(micrometres)).toEqual(["+1.2", "\u22120.4", "0.0", "0.0", "+100.0"]);
});

test("a pose is named by the axes that turn or that a vector places", () => {
  const poses = [pose(0, 0), pose(-60, 0), pose(12.5, 240)];
  expect(lettersOf(result(poses), "XYZ")).toEqual(["A", "C"]);
  expect(poses.map((one) => poseName(one, ["A", "C"]))).toEqual(["A0 C0", "A\u221260 C0", "A12.5 C240"]);
  expect(lettersOf({ ...result([pose(0, 0)]), vectors: [{ axis: "U" } as never] }, "XYZB")).toEqual(["B", "U"]);
});

test("a vector is three rows with its change", () => {
  const rows = vectorRows([{ axis: "A", before: [1, 2, 3], after: [1, 2.01, 2.5], uncertainty: [0.001, 0.002, 0.003], direction_before: [], direction_after: [] }]);
  expect(rows.map(({ component, uncertainty }) => [component, uncertainty])).toEqual([["X", 0.001], ["Y", 0.002], ["Z", 0.003]]);
  expect(rows.map(({ change }) => Number(change.toFixed(9)))).toEqual([0, 0.01, -0.5]);
});

test("the inclination is the angle between the directions", () => {
  const tilted = { axis: "A", before: [], after: [], uncertainty: [], direction_before: [-1, 0, 0], direction_after: [-Math.cos(36e-6), 0, Math.sin(36e-6)] };
  expect(inclination(tilted)).toBeCloseTo(36, 6);
});

test("the plot reaches to the next round number above the largest deviation", () => {
  const poses = [pose(0, 0, [0.001, -0.0031, 0], [0.12, 0, 0]), pose(10, 0, [0.003, 0, 0], [0, -0.15, 0])];
  expect(largest(poses, "residual")).toEqual({ pose: poses[0], component: 1, value: -0.0031 });
  expect(plotRange(poses, "residual")).toBe(5);
  expect(plotRange(poses, "difference")).toBe(200);
  expect(plotRange([pose(0, 0, [0.0002, 0, 0])], "residual")).toBe(1);
  expect(plotRange([pose(0, 0, [0.01, 0, 0])], "residual")).toBe(10);
  expect(largest([pose(0, 0)], "residual")).toBeUndefined();
});

test("a result is waited for until it is that of the state", () => {
  const kept = result([pose(0, 0), pose(1, 0), pose(2, 0), pose(3, 0)], false);
  expect(isOf(state("MEASURING"), undefined)).toBe(false);
  expect(isOf(state("MEASURING"), { ...kept, measurement: 2 })).toBe(false);
  expect(isOf(state("MEASURING", { complete: 5 }), kept)).toBe(false);
  expect(isOf(state("MEASURING"), kept)).toBe(true);
  expect(isOf(state("WAITING"), kept)).toBe(false);
  expect(isOf(state("WAITING"), { ...kept, valid: true })).toBe(true);
  expect(isOf(state("NOTHING"), undefined)).toBe(true);
});
