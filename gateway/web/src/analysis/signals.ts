// SPDX-License-Identifier: Apache-2.0
// What follows from sampled positions: speeds, accelerations, jerks, following errors, spectra, differences.
import { type Column, type Recording, rowAt } from "./recording";

export type Quantity = "speed" | "acceleration" | "jerk" | "following";

/** Derivative by central differences over the rows' own times, per second. The ends have those of one side. */
export function derivative(values: ArrayLike<number>, cycles: ArrayLike<number>, period: number): Float64Array {
  const count = values.length;
  const result = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    const [before, after] = [Math.max(0, i - 1), Math.min(count - 1, i + 1)];
    const time = (cycles[after]! - cycles[before]!) * period;
    result[i] = time > 0 ? (values[after]! - values[before]!) / time : 0;
  }
  return result;
}

/** Length of the vector of these columns in every row. */
export function magnitude(columns: readonly ArrayLike<number>[]): Float64Array {
  const result = new Float64Array(columns[0]?.length ?? 0);
  for (let i = 0; i < result.length; ++i) {
    let sum = 0;
    for (const column of columns) sum += column[i]! * column[i]!;
    result[i] = Math.sqrt(sum);
  }
  return result;
}

/** Times derived: 1 speed, 2 acceleration, 3 jerk. */
const orders: Record<Exclude<Quantity, "following">, number> = { speed: 1, acceleration: 2, jerk: 3 };

/**
 * A quantity of the axes `letters` together (length of the vector) or of one (with its sign): mm/s, mm/s^2, mm/s^3 (degrees
 * for a rotary axis) and mm.
 * Undefined when the recording does not have it.
 */
export function quantityOf(
  quantity: Quantity, letters: readonly string[], positions: Map<string, Float64Array>, commanded: Map<string, Float64Array>,
  cycles: ArrayLike<number>, period: number,
): Float64Array | undefined {
  const columns = letters.map((letter) => positions.get(letter));
  if (columns.length === 0 || columns.some((column) => !column)) return undefined;
  if (quantity === "following") {
    const wanted = letters.map((letter) => commanded.get(letter));
    if (wanted.some((column) => !column)) return undefined;
    return together(columns.map((column, k) => column!.map((value, i) => wanted[k]![i]! - value)));
  }
  return together(columns.map((column) => {
    let values: Float64Array = column!;
    for (let i = 0; i < orders[quantity]; ++i) values = derivative(values, cycles, period);
    return values;
  }));
}

/** One axis has a sign, several are a vector. */
const together = (columns: Float64Array[]) => (columns.length === 1 ? columns[0]! : magnitude(columns));

export interface Envelope {
  x: Float64Array;
  /** Of each column, with gaps as NaN. */
  y: Float64Array[];
}

/** At most two points for each of `buckets` parts of the rows first..last: the smallest and the largest value of each column. */
export function envelope(recording: Recording, columns: readonly ArrayLike<number>[], first: number, last: number, buckets: number): Envelope {
  const count = Math.max(0, last - first + 1);
  const base = recording.cycles[0] ?? 0;
  const at = (row: number) => (recording.cycles[row]! - base) * recording.period;
  if (count <= 2 * buckets)
    return {
      x: Float64Array.from({ length: count }, (_, i) => at(first + i)),
      y: columns.map((column) => Float64Array.from({ length: count }, (_, i) => column[first + i]!)),
    };
  const x = new Float64Array(2 * buckets);
  const y = columns.map(() => new Float64Array(2 * buckets));
  for (let bucket = 0; bucket < buckets; ++bucket) {
    const from = first + Math.floor((bucket * count) / buckets);
    const to = first + Math.floor(((bucket + 1) * count) / buckets);
    x[2 * bucket] = at(from);
    x[2 * bucket + 1] = at(Math.floor((from + to) / 2));
    columns.forEach((column, k) => {
      let [low, high] = [Infinity, -Infinity];
      for (let i = from; i < to; ++i) {
        const value = column[i]!;
        if (value < low) low = value;
        if (value > high) high = value;
      }
      y[k]![2 * bucket] = low === Infinity ? NaN : low;
      y[k]![2 * bucket + 1] = high === -Infinity ? NaN : high;
    });
  }
  return { x, y };
}

export interface Spectrum {
  /** Hz. */
  frequencies: Float64Array;
  /** Amplitude of a sine of that frequency, in the unit of the signal. */
  amplitudes: Float64Array;
}

/** In place: radix 2, decimation in time (Cooley and Tukey, 1965). */
function transform(real: Float64Array, imaginary: Float64Array): void {
  const n = real.length;
  for (let i = 1, j = 0; i < n; ++i) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      [real[i], real[j]] = [real[j]!, real[i]!];
      [imaginary[i], imaginary[j]] = [imaginary[j]!, imaginary[i]!];
    }
  }
  for (let size = 2; size <= n; size <<= 1) {
    const half = size >> 1;
    for (let k = 0; k < half; ++k) {
      const angle = (-2 * Math.PI * k) / size;
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      for (let start = k; start < n; start += size) {
        const other = start + half;
        const re = real[other]! * cos - imaginary[other]! * sin;
        const im = real[other]! * sin + imaginary[other]! * cos;
        real[other] = real[start]! - re;
        imaginary[other] = imaginary[start]! - im;
        real[start]! += re;
        imaginary[start]! += im;
      }
    }
  }
}

export const mostSpectrumRows = 1 << 16;

/**
 * Amplitude spectrum of the rows first..last: without the straight line from end to end, Hann window, of the newest 2^k rows
 * at most mostSpectrumRows. Rows that are missing are interpolated. Undefined below 16 rows.
 */
export function spectrum(values: ArrayLike<number>, cycles: ArrayLike<number>, period: number, first: number, last: number): Spectrum | undefined {
  const span = cycles[last]! - cycles[first]!;
  const rows = last - first + 1;
  if (rows < 16 || span <= 0) return undefined;
  // The most frequent distance of the rows is that of a row that is not missing.
  const steps = new Map<number, number>();
  for (let i = first + 1; i <= last; ++i) steps.set(cycles[i]! - cycles[i - 1]!, (steps.get(cycles[i]! - cycles[i - 1]!) ?? 0) + 1);
  const step = Math.max(1e-9, [...steps].sort((a, b) => b[1] - a[1] || a[0] - b[0])[0]![0]);
  const n = Math.min(mostSpectrumRows, 2 ** Math.floor(Math.log2(span / step + 1)));
  if (n < 16) return undefined;
  const real = new Float64Array(n), imaginary = new Float64Array(n);
  const start = cycles[last]! - (n - 1) * step;
  for (let i = 0, row = rowAt(cycles, start); i < n; ++i) {
    const cycle = start + i * step;
    while (row < last && cycles[row + 1]! <= cycle) ++row;
    const next = Math.min(row + 1, last);
    const way = cycles[next]! - cycles[row]!;
    const share = way > 0 ? Math.min(1, Math.max(0, (cycle - cycles[row]!) / way)) : 0;
    real[i] = (values[row]! || 0) + share * ((values[next]! || 0) - (values[row]! || 0));
  }
  const [from, to] = [real[0]!, real[n - 1]!];
  for (let i = 0; i < n; ++i) {
    const line = from + ((to - from) * i) / (n - 1);
    real[i] = (real[i]! - line) * (1 - Math.cos((2 * Math.PI * i) / n));
  }
  transform(real, imaginary);
  const half = n >> 1;
  const frequency = 1 / (n * step * period);
  return {
    frequencies: Float64Array.from({ length: half }, (_, i) => i * frequency),
    // The window, 1 - cos, has the mean 1; half of a sine's amplitude is at the negative frequency.
    amplitudes: Float64Array.from({ length: half }, (_, i) => ((i === 0 ? 1 : 2) * Math.hypot(real[i]!, imaginary[i]!)) / n),
  };
}

/** First row in which one of the columns has left its first value by more than `threshold`. */
export function startOfMotion(columns: readonly ArrayLike<number>[], threshold = 0.01): number {
  const count = columns[0]?.length ?? 0;
  for (let row = 0; row < count; ++row) if (columns.some((column) => Math.abs(column[row]! - column[0]!) > threshold)) return row;
  return 0;
}

/** `a` less `b`, of the columns that both have, in the cycles of `a`; `shift` is added to a cycle of `a` to give that of `b`. */
export function difference(a: Recording, b: Recording, shift: number): Recording {
  const columns = a.columns.flatMap((column): Column[] => {
    const other = b.columns.find(({ name }) => name === column.name);
    if (!other) return [];
    const values = new Float64Array(column.values.length).fill(NaN);
    let row = 0;
    for (let i = 0; i < values.length; ++i) {
      const cycle = a.cycles[i]! + shift;
      while (row + 1 < b.cycles.length && b.cycles[row + 1]! <= cycle) ++row;
      if (b.cycles[row] === cycle) values[i] = column.values[i]! - other.values[row]!;
    }
    return [{ name: `\u0394 ${column.name}`, unit: column.unit, values }];
  });
  return { ...a, columns };
}

/** Row of the largest magnitude; undefined when there is no number. */
export function largest(values: ArrayLike<number>): number | undefined {
  let found: number | undefined;
  for (let i = 0; i < values.length; ++i)
    if (!Number.isNaN(values[i]!) && (found === undefined || Math.abs(values[i]!) > Math.abs(values[found]!))) found = i;
  return found;
}
