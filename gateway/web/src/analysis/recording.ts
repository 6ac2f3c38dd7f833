// SPDX-License-Identifier: Apache-2.0
// Sampled signals as columns: a file that was opened, or what was sampled from the stream.

export interface Column {
  name: string;
  /** Empty where the file does not say it. */
  unit: string;
  values: Float64Array;
}

export interface Recording {
  name: string;
  /** Interpolation cycle of each row, ascending. */
  cycles: Float64Array;
  /** Seconds of one cycle. */
  period: number;
  columns: Column[];
}

/** A file of this computer, or the table of a recording of the machine. */
export interface Source {
  name: string;
  file?: File;
  url?: string;
}

/** Index of the last row that is not after `cycle`; 0 when all are. */
export function rowAt(cycles: ArrayLike<number>, cycle: number): number {
  let [low, high] = [0, cycles.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (cycles[middle]! <= cycle) low = middle;
    else high = middle - 1;
  }
  return Math.max(0, low);
}

/** Seconds since the first row. */
export const secondsOf = (recording: Recording, row: number) => ((recording.cycles[row] ?? 0) - (recording.cycles[0] ?? 0)) * recording.period;

const named = [..."XYZABCUVW"];

/**
 * Columns of the positions of X Y Z A B C U V W that a recording has: `setpoint` of the path, `actual` or `commanded` of
 * the drive. The drive's columns are its axes in the order of their numbers: `letters` names them.
 */
export function axisColumns(recording: Recording, kind: "setpoint" | "actual" | "commanded", letters: string): Map<string, Float64Array> {
  const found = new Map<string, Float64Array>();
  const values = (name: string) => recording.columns.find((column) => column.name === name)?.values;
  for (const letter of named) {
    const index = letters.indexOf(letter);
    const column = kind === "setpoint" ? values(`setpoint.${letter}`) : (values(`${kind}.${letter}`) ?? (index < 0 ? undefined : values(`${kind}[${index}]`)));
    if (column) found.set(letter, column);
  }
  return found;
}

/** The drive's columns with the letters of the channel in place of their numbers, when they are as many. */
export function withLetters(recording: Recording, letters: string): Recording {
  const numbered = /^(actual|commanded)\[(\d+)\]$/;
  const count = recording.columns.filter(({ name }) => /^actual\[/.test(name)).length;
  if (count !== letters.length) return recording;
  const columns = recording.columns.map((column) => {
    const [, kind, index] = numbered.exec(column.name) ?? [];
    const letter = letters[Number(index)];
    return kind && letter ? { ...column, name: `${kind}.${letter}`, unit: "ABC".includes(letter) ? "\u00b0" : "mm" } : column;
  });
  return { ...recording, columns };
}

/** CSV of the rows from `first` to `last`, both included. */
export function csvOf(recording: Recording, first: number, last: number): string {
  const lines = [["cycle", "seconds", ...recording.columns.map(({ name }) => name)].join(",")];
  for (let row = first; row <= last && row < recording.cycles.length; ++row)
    lines.push([recording.cycles[row], secondsOf(recording, row).toFixed(6), ...recording.columns.map(({ values }) => (Number.isNaN(values[row]!) ? "" : values[row]))].join(","));
  return lines.join("\n") + "\n";
}

const blank = 32, newline = 10, carriage = 13, comma = 44, quote = 34, minus = 45, plus = 43, point = 46, zero = 48;
const powers = Float64Array.from({ length: 309 }, (_, i) => Number(`1e${i}`));

export class BadCsv extends Error {
  constructor(readonly line: number, readonly what: "empty" | "no-cycle" | "no-number") {
    super(`line ${line}: ${what}`);
  }
}

/** Columns that say nothing about motion, and would fill the memory. */
const left = /^(snapshot\.|states|channel$|epoch$|revision$|starts$|ends$|seconds$|tick$|time_utc$)/;
export const mostColumns = 64;

/**
 * What `trunnion export FILE --csv feedback` (or path_batch, batches of axes) writes, and what this page exports: a line of
 * names with `cycle`, then numbers. Columns of texts are left out. Throws BadCsv.
 */
export function parseCsv(bytes: Uint8Array, name: string, period: number): Recording {
  const end = bytes.indexOf(newline);
  if (bytes.length === 0) throw new BadCsv(1, "empty");
  const names = new TextDecoder().decode(bytes.subarray(0, end < 0 ? bytes.length : end)).replace(/^\uFEFF|\r$/g, "").split(",").map((one) => one.trim());
  const cycleColumn = names.indexOf("cycle");
  if (cycleColumn < 0) throw new BadCsv(1, "no-cycle");
  let rows = end < 0 || end === bytes.length - 1 ? 0 : 1;
  for (let at = bytes.indexOf(newline, end + 1); rows > 0 && at >= 0 && at < bytes.length - 1; at = bytes.indexOf(newline, at + 1)) ++rows;
  if (rows === 0) throw new BadCsv(2, "empty");
  const wanted: (Float64Array | undefined)[] = names.map((one, i) => (i === cycleColumn || !left.test(one) ? new Float64Array(0) : undefined));
  let kept = 0;
  for (const [i, one] of wanted.entries()) wanted[i] = one && (i === cycleColumn || ++kept <= mostColumns) ? new Float64Array(rows) : undefined;
  const { length } = bytes;
  let [row, column] = [0, 0];
  for (let at = end + 1; at < length; ) {
    const values = wanted[column];
    const from = at;
    let value = NaN;
    if (values) {
      // The number is computed while it is read: right to 1 in 10^15, which is more than any signal has.
      let byte = bytes[at]!;
      while (byte === blank) byte = bytes[++at]!;
      const negative = byte === minus;
      if (negative || byte === plus) byte = bytes[++at]!;
      let mantissa = 0, exponent = 0, digits = 0;
      for (let digit = byte - zero; digit >= 0 && digit <= 9; digit = byte - zero) {
        if (mantissa < 9e14) mantissa = 10 * mantissa + digit;
        else ++exponent;
        ++digits;
        byte = bytes[++at]!;
      }
      if (byte === point) {
        byte = bytes[++at]!;
        for (let digit = byte - zero; digit >= 0 && digit <= 9; digit = byte - zero) {
          if (mantissa < 9e14) {
            mantissa = 10 * mantissa + digit;
            --exponent;
          }
          ++digits;
          byte = bytes[++at]!;
        }
      }
      if ((byte | 32) === 101) {
        byte = bytes[++at]!;
        const down = byte === minus;
        if (down || byte === plus) byte = bytes[++at]!;
        let power = 0;
        if (!(byte >= zero && byte <= zero + 9)) digits = 0;
        for (; byte >= zero && byte <= zero + 9; byte = bytes[++at]!) power = Math.min(400, 10 * power + byte - zero);
        exponent += down ? -power : power;
      }
      while (byte === carriage || byte === blank) byte = bytes[++at]!;
      if (digits > 0 && (at >= length || byte === comma || byte === newline)) {
        value = exponent === 0 ? mantissa : exponent < 0 ? (exponent < -308 ? 0 : mantissa / powers[-exponent]!) : exponent > 308 ? Infinity : mantissa * powers[exponent]!;
        if (negative) value = -value;
      }
    }
    for (let quoted = false; at < length && (quoted || (bytes[at] !== comma && bytes[at] !== newline)); ++at) if (bytes[at] === quote) quoted = !quoted;
    const ends = at >= length || bytes[at] === newline;
    ++at;
    if (ends && column === 0 && at - from <= 2 && (at - from === 1 || bytes[from] === carriage)) continue;  // an empty line
    if (values) values[row] = value;
    if (column === cycleColumn && Number.isNaN(value)) throw new BadCsv(row + 2, "no-number");
    ++column;
    if (!ends) continue;
    for (; column < names.length; ++column) {
      if (column === cycleColumn) throw new BadCsv(row + 2, "no-number");
      if (wanted[column]) wanted[column]![row] = NaN;
    }
    column = 0;
    ++row;
  }
  const cycles = wanted[cycleColumn]!.subarray(0, row);
  const columns = names.flatMap((one, i): Column[] => {
    const values = wanted[i]?.subarray(0, row);
    return i === cycleColumn || !values || values.every(Number.isNaN) ? [] : [{ name: one, unit: "", values }];
  });
  return { name, cycles, period, columns };
}
