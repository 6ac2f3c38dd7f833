// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { axisColumns, BadCsv, csvOf, parseCsv, rowAt, type Recording, withLetters } from "../src/analysis/recording";
import { Sampler } from "../src/analysis/sampler";
import { derivative, difference, envelope, largest, quantityOf, spectrum, startOfMotion } from "../src/analysis/signals";
import { tipColumns } from "../src/analysis/tip";
import { Chain } from "../src/scene/chain";

const bytes = (text: string) => new TextEncoder().encode(text);
const recording = (columns: Record<string, number[]>, cycles?: number[]): Recording => {
  const count = Object.values(columns)[0]!.length;
  return {
    name: "r", period: 0.001, cycles: Float64Array.from(cycles ?? Array.from({ length: count }, (_, i) => i)),
    columns: Object.entries(columns).map(([name, values]) => ({ name, unit: "", values: Float64Array.from(values) })),
  };
};

test("an exported topic is read: cycles, numbers, gaps; texts and snapshots are left out", () => {
  const read = parseCsv(bytes("cycle,channel,actual[0],line,transformation,snapshot.tool\n10,0,-1.5e-3,7,RTCP,1\n11,0,+2.25,,RTCP,1\r\n12,0,1e2,8,\"a,b\",1"), "f", 0.001);
  expect([...read.cycles]).toEqual([10, 11, 12]);
  expect(read.columns.map(({ name, values }) => [name, [...values]])).toEqual([["actual[0]", [-0.0015, 2.25, 100]], ["line", [7, NaN, 8]]]);
});

test("numbers are those of the text to 1 in 10^15", () => {
  let seed = 11;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  const values = Array.from({ length: 2000 }, () => (random() - 0.5) * 10 ** Math.floor(random() * 40 - 20));
  const read = parseCsv(bytes(`cycle,x\n${values.map((value, i) => `${i},${value}`).join("\n")}\n`), "f", 1).columns[0]!.values;
  values.forEach((value, i) => expect(Math.abs(read[i]! - value)).toBeLessThanOrEqual(2e-15 * Math.abs(value)));
});

test("what is no export is refused with its line", () => {
  const line = (text: string) => {
    try {
      parseCsv(bytes(text), "f", 1);
      return 0;
    } catch (error) {
      return error instanceof BadCsv ? [error.line, error.what] : error;
    }
  };
  expect(line("")).toEqual([1, "empty"]);
  expect(line("a,b\n1,2\n")).toEqual([1, "no-cycle"]);
  expect(line("cycle,x\n")).toEqual([2, "empty"]);
  expect(line("cycle,x\n1,2\nx,3\n")).toEqual([3, "no-number"]);
});

test("any bytes are read or refused", () => {
  let seed = 5;
  const random = (n: number) => (seed = (seed * 48271) % 2147483647) % n;
  const letters = "0123456789.,,,\n\n\r-+eE\" cyclex";
  for (let round = 0; round < 2000; ++round) {
    const text = `cycle,x,y\n${Array.from({ length: random(80) }, () => letters[random(letters.length)]).join("")}`;
    try {
      const read = parseCsv(bytes(text), "f", 1);
      for (const { values } of read.columns) expect(values.length).toBe(read.cycles.length);
    } catch (error) {
      expect(error).toBeInstanceOf(BadCsv);
    }
  }
});

test("what is exported is read again", () => {
  const made = recording({ "actual.X": [0.1, 0.25, NaN], "actual.Y": [1, 2, 3] }, [5, 6, 9]);
  const again = parseCsv(bytes(csvOf(made, 0, 2)), "r", 0.001);
  expect([...again.cycles]).toEqual([5, 6, 9]);
  expect([...axisColumns(again, "actual", "XY").get("X")!]).toEqual([0.1, 0.25, NaN]);
});

test("the drive's columns are named by the letters, the path's by their names", () => {
  const drive = recording({ "actual[0]": [1], "actual[1]": [2], "actual[2]": [3] });
  expect([...axisColumns(drive, "actual", "XZC")].map(([letter, values]) => [letter, values[0]])).toEqual([["X", 1], ["Z", 2], ["C", 3]]);
  expect([...axisColumns(recording({ "setpoint.X": [7], "setpoint.A": [8] }), "setpoint", "")].map(([letter]) => letter)).toEqual(["X", "A"]);
});

test("columns get the letters of the machine when they are as many", () => {
  const drive = recording({ "actual[0]": [1], "actual[1]": [2], "commanded[1]": [3] });
  expect(withLetters(drive, "XC").columns.map(({ name, unit }) => [name, unit])).toEqual([["actual.X", "mm"], ["actual.C", "\u00b0"], ["commanded.C", "\u00b0"]]);
  expect(withLetters(drive, "XYZ")).toBe(drive);
});

test("a row is found by its cycle", () => {
  expect([0, 5, 7, 9, 100].map((cycle) => rowAt([5, 7, 8], cycle))).toEqual([0, 0, 1, 2, 2]);
});

test("speed, acceleration and jerk of a cubic are its derivatives", () => {
  // x = t^3 with t in s: 3 t^2, 6 t and 6; central differences of a cubic are off by h^2 = 1e-6 times its third derivative / 6.
  const cycles = Float64Array.from({ length: 101 }, (_, i) => i);
  const x = cycles.map((i) => (i / 1000) ** 3);
  const of = (quantity: "speed" | "acceleration" | "jerk") => quantityOf(quantity, ["X"], new Map([["X", x]]), new Map(), cycles, 0.001)![50]!;
  expect(of("speed")).toBeCloseTo(3 * 0.05 ** 2, 5);
  expect(of("acceleration")).toBeCloseTo(6 * 0.05, 5);
  expect(of("jerk")).toBeCloseTo(6, 5);
});

test("the speed of two axes is that of their vector, also where rows are missing", () => {
  const cycles = Float64Array.from([0, 1, 4, 5]);
  const positions = new Map([["X", cycles.map((c) => 3 * c)], ["Y", cycles.map((c) => 4 * c)]]);
  // 3 and 4 mm a cycle of 1 ms are 5 m/s.
  for (const value of quantityOf("speed", ["X", "Y"], positions, new Map(), cycles, 0.001)!) expect(value).toBeCloseTo(5000, 6);
  const commanded = new Map([["X", cycles.map((c) => 3 * c + 0.3)], ["Y", cycles.map((c) => 4 * c - 0.4)]]);
  for (const value of quantityOf("following", ["X", "Y"], positions, commanded, cycles, 0.001)!) expect(value).toBeCloseTo(0.5, 9);
  for (const value of quantityOf("following", ["Y"], positions, commanded, cycles, 0.001)!) expect(value).toBeCloseTo(-0.4, 9);
  expect(quantityOf("following", ["X"], positions, new Map(), cycles, 0.001)).toBeUndefined();
  expect(derivative([1], [1], 0.001)[0]).toBe(0);
});

test("the speed on the workpiece is the tip's, whatever the axes do to keep it", () => {
  // The table turns about -Z through machine X0 Y0: a point (x, y) of the workpiece is at Rz(-C) (x, y). The tip goes along X of
  // the workpiece with 33.95 mm/s at Y-20, from X-50, while C turns with 60 deg/s: worked out here, without the chain.
  const [speed, omega, toolLength] = [33.95, Math.PI / 3, 100];
  const columns = (delay: number) => {
    const at = (of: (x: number, turned: number) => number) =>
      Float64Array.from({ length: 3001 }, (_, i) => of(-50 + speed * (i / 1000 + delay), omega * (i / 1000 + delay)));
    return new Map([
      ["X", at((x, c) => Math.cos(c) * x + Math.sin(c) * -20)],
      ["Y", at((x, c) => -Math.sin(c) * x + Math.cos(c) * -20)],
      ["Z", at(() => -300 + toolLength)],
      ["C", at((_, c) => (c * 180) / Math.PI)],
    ]);
  };
  const parameters: Record<number, number> = { 402: 1, 425: 5, 431: -1, 437: -400, 932: 1, 936: 1, 940: 1 };
  const chain = new Chain((offset) => parameters[offset] ?? 0);
  const cycles = Float64Array.from({ length: 3001 }, (_, i) => i);
  const tips = tipColumns(chain, columns(0), toolLength);
  const ahead = tipColumns(chain, columns(0.01), toolLength);
  for (const value of quantityOf("speed", ["X", "Y", "Z"], tips, ahead, cycles, 0.001)!) expect(value).toBeCloseTo(speed, 6);
  // Commanded 10 ms ahead: 0.3395 mm along the path.
  for (const value of quantityOf("following", ["X", "Y", "Z"], tips, ahead, cycles, 0.001)!) expect(value).toBeCloseTo(speed * 0.01, 9);
  // Of the machine's axes it is |(v - 20 w, -w x)| with w = pi / 3: 13.01 mm/s where x = 0, 55.8 mm/s where x = 51.85.
  const axes = quantityOf("speed", ["X", "Y", "Z"], columns(0), new Map(), cycles, 0.001)!;
  expect(Math.min(...axes)).toBeCloseTo(speed - 20 * omega, 2);
  expect(Math.max(...axes)).toBeCloseTo(Math.hypot(speed - 20 * omega, 51.85 * omega), 1);
  expect(tipColumns(chain, new Map(), toolLength).size).toBe(0);
});

test("a sine has its frequency and amplitude in the spectrum, over an offset and a slope", () => {
  const values = Array.from({ length: 5000 }, (_, i) => 0.5 * Math.sin((2 * Math.PI * 62.5 * i) / 1000) + 3 + i / 500);
  const cycles = values.map((_, i) => i);
  const { frequencies, amplitudes } = spectrum(values, cycles, 0.001, 0, 4999)!;
  // 4096 rows of 1 ms: 62.5 Hz is line 256 exactly.
  const peak = largest(amplitudes)!;
  expect(frequencies[peak]).toBeCloseTo(62.5, 9);
  expect(amplitudes[peak]).toBeCloseTo(0.5, 3);
  expect(spectrum(values, cycles, 0.001, 0, 10)).toBeUndefined();
});

test("rows that are missing do not move the frequency", () => {
  const all = Array.from({ length: 2048 }, (_, i) => i).filter((i) => i % 17 !== 5);
  const values = all.map((i) => Math.sin((2 * Math.PI * 50 * i) / 1000));
  const { frequencies, amplitudes } = spectrum(values, all, 0.001, 0, all.length - 1)!;
  expect(Math.abs(frequencies[largest(amplitudes)!]! - 50)).toBeLessThan(1);
});

test("an envelope keeps every peak", () => {
  const values = Float64Array.from({ length: 100_000 }, (_, i) => (i === 77_777 ? 9 : i === 33_333 ? -9 : 0));
  const made = envelope(recording({ x: [...values] }), [values], 0, 99_999, 500);
  expect(made.x.length).toBe(1000);
  expect([Math.max(...made.y[0]!), Math.min(...made.y[0]!)]).toEqual([9, -9]);
  expect(made.x.every((value, i) => i === 0 || value >= made.x[i - 1]!)).toBe(true);
});

test("the difference of two runs is that of the same cycle, from the start of the motion", () => {
  const a = recording({ x: [0, 0, 1, 2, 3] }), b = recording({ x: [0, 1.5, 2.5, 3.5] }, [100, 101, 102, 103]);
  const shift = b.cycles[startOfMotion(b.columns.map(({ values }) => values))]! - a.cycles[startOfMotion(a.columns.map(({ values }) => values))]!;
  expect(shift).toBe(99);
  const made = difference(a, b, shift).columns[0]!;
  expect([made.name, [...made.values]]).toEqual(["\u0394 x", [NaN, 0, -0.5, -0.5, -0.5]]);
});

test("a trigger keeps what was before it, and ends after its time", () => {
  const sampler = new Sampler(["a", "b"], [], { signal: 1, edge: "rising", level: 5 }, 10, 3);
  for (let cycle = 0; cycle < 100; ++cycle) sampler.push(cycle, [cycle, cycle >= 50 ? 6 : 0]);
  expect([sampler.state, sampler.triggered]).toEqual(["done", 50]);
  const made = sampler.recording("s", 0.001);
  expect([made.cycles[0], made.cycles[made.cycles.length - 1]]).toEqual([47, 57]);
  expect([...made.columns[0]!.values]).toEqual([...made.cycles]);
});

test("without a trigger everything is sampled from the start on, rows that come again once, the oldest fall out", () => {
  const sampler = new Sampler(["a"], [], { signal: 0, edge: "none", level: 0 }, 1000, 0, 4);
  for (const cycle of [1, 2, 2, 1, 3, 4, 5]) sampler.push(cycle, [cycle]);
  expect([...sampler.recording("s", 1).cycles]).toEqual([2, 3, 4, 5]);
  expect(sampler.state).toBe("triggered");
  const falling = new Sampler(["a"], [], { signal: 0, edge: "falling", level: 2 }, 5, 0);
  for (const value of [1, 3, 1]) falling.push(value === 3 ? 1 : falling.rows * 2, [value]);
  expect(falling.state).toBe("triggered");
});
