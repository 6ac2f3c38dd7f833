// SPDX-License-Identifier: Apache-2.0
// Parameters as text, in the form of `trunnion param export` and of the state directory: lines "100034": 25000  # about.
import type { Parameter } from "../contract";

export const sixDigits = (number: number) => String(number).padStart(6, "0");

/** What is stored: the active value, or the one that waits for its activation. */
export const storedValue = (one: Parameter) => (one.pending ? one.pending_value! : one.value);

export interface FileLine {
  /** From 1. */
  line: number;
  number: number;
  value: string;
}

export interface ParameterFile {
  rows: FileLine[];
  /** Lines that are no parameter. */
  bad: { line: number; text: string }[];
}

const entry = /^\s*["']?(\d{1,6})["']?\s*:\s*("(?:[^"\\]|\\.)*"|'(?:[^']|'')*'|[^#]*?)\s*(?:\s#.*)?$/;

function unquoted(text: string): string {
  if (text.startsWith('"')) {
    try {
      return String(JSON.parse(text));
    } catch {
      return text.slice(1, -1);
    }
  }
  return text.startsWith("'") ? text.slice(1, -1).replace(/''/g, "'") : text === "~" ? "" : text;
}

/** Empty lines and comments are passed over. */
export function parseParameters(text: string): ParameterFile {
  const file: ParameterFile = { rows: [], bad: [] };
  text.replace(/^\uFEFF/, "").split(/\r?\n/).forEach((content, index) => {
    if (/^\s*(#.*)?$/.test(content) || /^---\s*$/.test(content)) return;
    const [, number, value] = entry.exec(content) ?? [];
    if (number === undefined || value === undefined) file.bad.push({ line: index + 1, text: content.trim().slice(0, 60) });
    else file.rows.push({ line: index + 1, number: Number(number), value: unquoted(value) });
  });
  return file;
}

const plain = /^[A-Za-z][A-Za-z0-9_]*$/;

/** The stored values that differ from their defaults; `all` also those that do not. */
export function writeParameters(parameters: readonly Parameter[], all: boolean): string {
  const lines = parameters
    .filter((one) => all || storedValue(one) !== one.default)
    .map((one) => {
      const value = storedValue(one);
      const written = typeof value === "string" ? (plain.test(value) && !/^(y|n|yes|no|on|off|true|false|null)$/i.test(value) ? value : JSON.stringify(value)) : String(value);
      return `"${sixDigits(one.number)}": ${written}  # ${one.name}${one.unit ? `, ${one.unit}` : ""}`;
    });
  return lines.join("\n") + (lines.length > 0 ? "\n" : "");
}

export type Verdict = "differs" | "same" | "unknown" | "not-a-number" | "limits" | "whole" | "twice" | "only-here";

export interface ComparedRow {
  number: number;
  parameter: Parameter | undefined;
  /** As it is in the file, or the default. */
  there: string;
  verdict: Verdict;
}

/** Would the control take this value? The control itself decides again. */
function verdictOf(parameter: Parameter | undefined, value: string): Verdict {
  if (!parameter) return "unknown";
  if (parameter.type === "text") return value === storedValue(parameter) ? "same" : "differs";
  const number = Number(value);
  if (value.trim() === "" || !Number.isFinite(number)) return "not-a-number";
  if (parameter.type === "integer" && !Number.isInteger(number)) return "whole";
  if (number < (parameter.minimum ?? -Infinity) || number > (parameter.maximum ?? Infinity)) return "limits";
  return number === storedValue(parameter) ? "same" : "differs";
}

/** Every row of the file that is not the same here, and what only here is not the default; ascending by number. */
export function compareWithFile(parameters: readonly Parameter[], file: ParameterFile): ComparedRow[] {
  const known = new Map(parameters.map((one) => [one.number, one]));
  const seen = new Set<number>();
  const rows: ComparedRow[] = file.rows.map(({ number, value }) => {
    const verdict = seen.has(number) ? "twice" : verdictOf(known.get(number), value);
    seen.add(number);
    return { number, parameter: known.get(number), there: value, verdict };
  });
  for (const one of parameters)
    if (!seen.has(one.number) && storedValue(one) !== one.default)
      rows.push({ number: one.number, parameter: one, there: "", verdict: "only-here" });
  return rows.filter(({ verdict }) => verdict !== "same").sort((a, b) => a.number - b.number);
}

export function compareWithDefaults(parameters: readonly Parameter[]): ComparedRow[] {
  return parameters
    .filter((one) => storedValue(one) !== one.default)
    .map((one) => ({ number: one.number, parameter: one, there: String(one.default ?? ""), verdict: "differs" }));
}

/** The bodies of PUT /api/parameters for the rows that differ: at most 4096 values each. */
export function importBodies(rows: readonly ComparedRow[]): { number: number; value?: number; text?: string }[][] {
  const values = rows
    .filter(({ verdict, parameter }) => verdict === "differs" && parameter)
    .map(({ number, parameter, there }) => (parameter!.type === "text" ? { number, text: there } : { number, value: Number(there) }));
  const bodies = [];
  for (let i = 0; i < values.length; i += 4096) bodies.push(values.slice(i, i + 4096));
  return bodies;
}
