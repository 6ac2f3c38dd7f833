// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { Chain } from "../src/scene/chain";
import { niceAbove, PathBuffer, speedColour } from "../src/scene/path";
import { History } from "../src/state/history";
import { type Channel, emptyState, type MachineState } from "../src/state/model";

const cartesian = new Chain((offset) => (({ 402: 1, 932: 1, 936: 1, 940: 1 }) as Record<number, number>)[offset] ?? 0);
const source = { chain: cartesian, toolLength: (tool: number) => (tool === 1 ? 100 : 0), period: 0.001 };
const channel = { feed: 0, axes: [0, 1, 2], letters: "XYZ", tool: 1 } as unknown as Channel;
/** Every second cycle when they are twice as many as the rows. */
const state = (first: number, executed: number, rows: number[][]) =>
  ({ ...emptyState, trace: { first, since: rows.map((_, i) => i * Math.max(1, Math.floor((executed - first + 1) / rows.length))), axes: [0, 1, 2], rows } }) as unknown as MachineState;

test("a point is the tip, and its speed that of the segment that leads to it", () => {
  const history = new History();
  // Two rows in four cycles are every second one: 0.1 mm in 2 ms are 3000 mm/min.
  history.record(0, state(10, 13, [[0, 0, 0], [0.1, 0, 0]]), channel);
  const buffer = new PathBuffer(100);
  expect(buffer.update(history, source)).toBe("all");
  expect([...buffer.points.subarray(0, 3)]).toEqual([0, 0, -100]);
  expect(buffer.speeds[1]).toBeCloseTo(3000, 2);
  expect([buffer.count, buffer.segments, buffer.scale]).toEqual([2, 1, 5000]);
  expect(buffer.update(history, source)).toBe("none");
  history.record(1, state(14, 14, [[0.3, 0, 0]]), channel);
  expect(buffer.update(history, source)).toBe("all"); // 0.2 mm in the 2 ms since cycle 12 are 6000 mm/min: another scale, every colour
  history.record(2, state(15, 15, [[0.4, 0, 0]]), channel);
  expect(buffer.update(history, source)).toEqual({ from: 3 });
});

test("points on both sides of a gap are not joined", () => {
  const history = new History();
  history.record(0, state(1, 2, [[0, 0, 0], [1, 0, 0]]), channel);
  history.interrupt();
  history.record(1, state(900, 901, [[50, 0, 0], [51, 0, 0]]), channel);
  const buffer = new PathBuffer(100);
  buffer.update(history, source);
  expect([buffer.count, buffer.segments]).toEqual([4, 2]);
  expect([...buffer.indices.subarray(0, 4)]).toEqual([0, 1, 2, 3]);
});

test("the oldest points are dropped when there is no more space, and the newest ones are right", () => {
  const history = new History();
  const buffer = new PathBuffer(40);
  for (let i = 0; i < 100; ++i) {
    history.record(i, state(i, i, [[i, 0, 0]]), channel);
    buffer.update(history, source);
    expect(buffer.points[3 * (buffer.count - 1)]).toBe(i);
    expect(buffer.segments).toBe(buffer.count - 1);
    for (let segment = 0; segment < buffer.segments; ++segment) {
      const [a, b] = [buffer.indices[2 * segment]!, buffer.indices[2 * segment + 1]!];
      expect(buffer.points[3 * b]! - buffer.points[3 * a]!).toBe(1);
    }
  }
  history.clear();
  expect(buffer.update(history, source)).toBe("all");
  expect(buffer.count).toBe(0);
});

test("a history that is longer than the buffer gives its newest points", () => {
  const history = new History();
  for (let i = 0; i < 100; ++i) history.record(i, state(i, i, [[i, 0, 0]]), channel);
  const buffer = new PathBuffer(200);
  buffer.update(history, source);
  expect([buffer.count, buffer.points[0], buffer.points[3 * 99]]).toEqual([100, 0, 99]);
});

test("colours go from blue to red, scales are 1, 2 or 5 times a power of ten", () => {
  expect(speedColour(-1)).toEqual(speedColour(0));
  expect(speedColour(2)).toEqual(speedColour(1));
  expect(speedColour(0)[2]).toBeGreaterThan(speedColour(0)[0]);
  expect(speedColour(1)[0]).toBeGreaterThan(speedColour(1)[2]);
  expect([0.9, 1, 1.1, 2, 3000, 5001].map(niceAbove)).toEqual([1, 1, 2, 2, 5000, 10000]);
});

test("what is drawn is within the tolerance of the path, joins up, and is the same however the points came", () => {
  // A spiral with a gap, then a straight line: 0.05 mm steps with noise from a linear congruential generator, seed 1.
  let seed = 1;
  const noise = () => ((seed = (1103515245 * seed + 12345) % 2147483648) / 2147483648 - 0.5) * 0.002;
  const rows = Array.from({ length: 4000 }, (_, i) =>
    i < 3000
      ? [20 * Math.cos(i / 400) * (1 + i / 9000), 20 * Math.sin(i / 400) * (1 + i / 9000), i / 1000 + noise()]
      : [100 + 0.05 * (i - 3000), noise(), 0]);
  const tolerance = 0.05;
  const drawnAfter = (chunk: number) => {
    const history = new History();
    const buffer = new PathBuffer(5000);
    for (let i = 0; i < rows.length; i += chunk) {
      if (i === 3000) history.interrupt();
      history.record(i, state(i + 1, i + chunk, rows.slice(i, i + chunk)), channel);
      buffer.update(history, source);
      buffer.simplify(tolerance);
    }
    return buffer;
  };
  const buffer = drawnAfter(3000);
  const pairs = Array.from({ length: buffer.drawnSegments }, (_, k) => [buffer.drawn[2 * k]!, buffer.drawn[2 * k + 1]!] as const);
  expect(buffer.segments).toBe(3998);
  expect(pairs.length).toBeLessThan(400);
  const gaps = pairs.filter(([from], k) => k > 0 && from !== pairs[k - 1]![1]);
  expect(gaps).toEqual([[3000, gaps[0]![1]]]);
  expect(pairs[0]![0]).toBe(0);
  expect(pairs[pairs.length - 1]![1]).toBe(3999);
  const at = (i: number) => [0, 1, 2].map((axis) => buffer.points[3 * i + axis]!);
  const distance = (p: number[], a: number[], b: number[]) => {
    const ab = b.map((value, i) => value - a[i]!);
    const ap = p.map((value, i) => value - a[i]!);
    const along = ap.reduce((sum, value, i) => sum + value * ab[i]!, 0) / Math.max(ab.reduce((sum, value) => sum + value * value, 0), 1e-12);
    return Math.hypot(...ap.map((value, i) => value - Math.min(1, Math.max(0, along)) * ab[i]!));
  };
  // Points are within the tolerance of the line through the first two of the strip, and the chord to its last point,
  // which is within it too, deviates from that line by no more: twice the tolerance.
  for (const [a, b] of pairs) for (let i = a; i <= b; ++i) expect(distance(at(i), at(a), at(b))).toBeLessThan(2 * tolerance + 1e-6);
  const again = drawnAfter(250);
  expect([...again.drawn.subarray(0, 2 * again.drawnSegments)]).toEqual([...buffer.drawn.subarray(0, 2 * buffer.drawnSegments)]);
});
