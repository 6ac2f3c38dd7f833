// SPDX-License-Identifier: Apache-2.0
// The measuring cycles of the control (docs/measuring-cycles.md): their fields, the MDI line that calls them, their results.
import { typedNumber } from "../format";

export type CycleName = "calibrate" | "surface" | "bore" | "boss" | "pocket" | "web" | "corner" | "angle";
export type FieldName = "diameter" | "ball" | "axis" | "expected" | "expectedX" | "expectedY" | "height" | "width" | "along" | "apart" | "offset" | "search";

export interface Cycle {
  name: CycleName;
  program: number;
  /** In the order of the form. */
  fields: FieldName[];
  /** Macro variables of the results, with the key of their title. */
  results: [number, ResultName][];
}
export type ResultName = "surfaceX" | "surfaceY" | "surfaceZ" | "centreX" | "centreY" | "cornerX" | "cornerY" | "middleX" | "middleY" | "diameter" | "width" | "deviation" | "angle" | "ballRadius" | "ballCorrection";

export const cycles: readonly Cycle[] = [
  { name: "calibrate", program: 9810, fields: ["diameter", "ball"], results: [[560, "ballRadius"], [561, "ballCorrection"]] },
  { name: "surface", program: 9811, fields: ["axis", "expected", "offset", "search"], results: [[130, "surfaceX"], [131, "surfaceY"], [132, "surfaceZ"], [134, "deviation"]] },
  { name: "bore", program: 9812, fields: ["diameter", "offset", "search"], results: [[130, "centreX"], [131, "centreY"], [133, "diameter"], [134, "deviation"]] },
  { name: "boss", program: 9812, fields: ["diameter", "height", "offset", "search"], results: [[130, "centreX"], [131, "centreY"], [133, "diameter"], [134, "deviation"]] },
  { name: "pocket", program: 9813, fields: ["axis", "width", "offset", "search"], results: [[130, "middleX"], [131, "middleY"], [133, "width"], [134, "deviation"]] },
  { name: "web", program: 9813, fields: ["axis", "width", "height", "offset", "search"], results: [[130, "middleX"], [131, "middleY"], [133, "width"], [134, "deviation"]] },
  { name: "corner", program: 9814, fields: ["expectedX", "expectedY", "along", "offset", "search"], results: [[130, "cornerX"], [131, "cornerY"]] },
  { name: "angle", program: 9815, fields: ["axis", "expected", "apart", "search"], results: [[130, "surfaceX"], [131, "surfaceY"], [134, "deviation"], [137, "angle"]] },
];

/** The axes that a cycle can be across. */
export const axesOf = (cycle: Cycle): string[] => (cycle.name === "surface" ? ["X", "Y", "Z"] : ["X", "Y"]);
/** Fields that may be left empty. */
export const optional: readonly FieldName[] = ["ball", "along", "offset", "search"];
const positive: readonly FieldName[] = ["diameter", "ball", "width", "along", "search"];

/** What is typed, by field; `axis` is a letter, `offset` empty or G54 .. G59, the others numbers in mm. */
export type Typed = Partial<Record<FieldName, string>>;

/** The fields that are missing or wrong; the line can be built when there are none. */
export function wrongFields(cycle: Cycle, typed: Typed): FieldName[] {
  return cycle.fields.filter((field) => {
    if (field === "axis" || field === "offset") return false;
    if ((typed[field] ?? "").trim() === "") return !optional.includes(field);
    const value = typedNumber(typed[field]);
    return value === undefined || (field === "apart" && value === 0) || Math.abs(value) > 100000 || (positive.includes(field) && value <= 0);
  });
}

/** `G65 P9812 D50 S1`. */
export function lineOf(cycle: Cycle, typed: Typed): string {
  const axis = axesOf(cycle).includes(typed.axis ?? "") ? typed.axis! : "X";
  const letters: Record<FieldName, string> = {
    diameter: "D", ball: "R", axis: "", expected: axis, expectedX: "X", expectedY: "Y", height: "Z", width: axis, along: "I", apart: "I", offset: "S", search: "Q",
  };
  const words = cycle.fields.flatMap((field) => {
    if (field === "axis") return [];
    if (field === "offset") return /^G5[4-9]$/.test(typed.offset ?? "") ? [`S${Number(typed.offset!.slice(1)) - 53}`] : [];
    const value = typedNumber(typed[field]);
    return value === undefined ? [] : [letters[field] + String(value)];
  });
  return [`G65 P${cycle.program}`, ...words].join(" ");
}

/** The key of a text: `measureCycle` and "bore" are measureCycleBore. */
export const titled = <Prefix extends string, Name extends string>(prefix: Prefix, name: Name) =>
  `${prefix}${name[0]!.toUpperCase()}${name.slice(1)}` as `${Prefix}${Capitalize<Name>}`;
