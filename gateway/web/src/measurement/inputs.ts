// SPDX-License-Identifier: Apache-2.0
// The inputs of a measurement of the kinematics: fields as they are typed, their limits, and the YAML that is sent.
import type { MeasurementInputs } from "../contract";
import { typedNumber } from "../format";

export interface RangeFields {
  letter: string;
  /** deg */
  start: string;
  end: string;
  points: string;
}

export interface Fields {
  mode: MeasurementInputs["mode"];
  /** X Y Z of the expected centre in the workpiece frame, mm */
  sphere: [string, string, string];
  /** mm */
  probeLength: string;
  axes: RangeFields[];
}

export const modes = ["measure_only", "correct", "only_correct"] as const;

export type Limits = readonly [number, number];
/** Of docs/calibration.md. A probe without a length is not a probe. */
export const sphereLimits: Limits = [-100000, 100000];
export const probeLimits: Limits = [0.001, 10000];
export const pointLimits: Limits = [3, 12];
const anyAngle: Limits = [-1e6, 1e6];

/** Travel of each rotary axis by its letter, deg. */
export type Travel = Record<string, number[]>;

export function angleLimits(travel: Travel, letter: string): Limits {
  const found = travel[letter];
  return found?.length === 2 ? [found[0]!, found[1]!] : anyAngle;
}

/** Fields of a machine that does not know its probe and sphere are empty: they must be typed. */
export function fieldsOf(inputs: MeasurementInputs): Fields {
  const known = inputs.probe.length_mm > 0;
  const [x, y, z] = inputs.sphere.centre_mm.map((value) => (known ? String(value) : ""));
  return {
    mode: inputs.mode,
    sphere: [x!, y!, z!],
    probeLength: known ? String(inputs.probe.length_mm) : "",
    axes: Object.entries(inputs.axes).map(([letter, range]) => ({
      letter, start: String(range.start_deg), end: String(range.end_deg), points: String(range.points),
    })),
  };
}

export type Fault = "number" | "whole" | "limits" | "order";

/** Where a value is: "X", "Y", "Z", "probe", or a letter with ".start", ".end", ".points". */
export type Place = string;

/** What is wrong with each field; empty when nothing is. */
export function faultsOf(fields: Fields, travel: Travel): Map<Place, Fault> {
  const faults = new Map<Place, Fault>();
  const look = (place: Place, typed: string, [low, high]: Limits, whole = false): number | undefined => {
    const value = typedNumber(typed);
    if (value === undefined) faults.set(place, "number");
    else if (whole && !Number.isInteger(value)) faults.set(place, "whole");
    else if (value < low || value > high) faults.set(place, "limits");
    else return value;
    return undefined;
  };
  fields.sphere.forEach((typed, i) => look("XYZ"[i]!, typed, sphereLimits));
  look("probe", fields.probeLength, probeLimits);
  for (const { letter, start, end, points } of fields.axes) {
    const limits = angleLimits(travel, letter);
    const [from, to] = [look(`${letter}.start`, start, limits), look(`${letter}.end`, end, limits)];
    look(`${letter}.points`, points, pointLimits, true);
    if (from !== undefined && to !== undefined && from >= to) faults.set(`${letter}.end`, "order");
  }
  return faults;
}

/** `base` with what is typed; only for fields without a fault. */
export function inputsOf(base: MeasurementInputs, fields: Fields): MeasurementInputs {
  const axes = Object.fromEntries(
    fields.axes.map(({ letter, start, end, points }) => [
      letter, { ...base.axes[letter]!, start_deg: typedNumber(start)!, end_deg: typedNumber(end)!, points: typedNumber(points)! },
    ]),
  );
  return {
    ...base,
    mode: fields.mode,
    sphere: { ...base.sphere, centre_mm: fields.sphere.map((typed) => typedNumber(typed)!) },
    probe: { ...base.probe, length_mm: typedNumber(fields.probeLength)! },
    axes,
  };
}

const scalar = (value: unknown) => (Array.isArray(value) ? `[${value.join(", ")}]` : String(value));

/** Maps, lists of numbers, numbers, truth values and plain words as YAML, a value in each line. */
export function yamlOf(map: object, indent = ""): string {
  return Object.entries(map)
    .map(([key, value]) =>
      typeof value === "object" && value !== null && !Array.isArray(value)
        ? `${indent}${key}:\n${yamlOf(value as object, `${indent}  `)}`
        : `${indent}${key}: ${scalar(value)}\n`)
    .join("");
}

export interface Refusal {
  text: string;
  /** Line of the YAML, from 1; 0 = none is named. */
  line: number;
  /** Letter of the axis that it names; empty = none. */
  axis: string;
}

/** What a refusal of the service names: "inputs:3:5: error: ..." or "axis A: ...". */
export function refusalOf(reason: string): Refusal {
  const place = /^inputs:(\d+):\d+: (?:error: )?/.exec(reason);
  const text = place ? reason.slice(place[0].length) : reason;
  return { text, line: place ? Number(place[1]) : 0, axis: /^axis ([A-CU-W])\b/.exec(text)?.[1] ?? "" };
}
