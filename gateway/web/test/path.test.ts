// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { Chain } from "../src/scene/chain";
import { niceAbove, PathBuffer, speedColour } from "../src/scene/path";
import { History } from "../src/state/history";
import { type Channel, emptyState, type MachineState } from "../src/state/model";

const cartesian = new Chain((offset) => (({ 402: 1, 932: 1, 936: 1, 940: 1 }) as Record<number, number>)[offset] ?? 0);
const source = { chain: cartesian, toolLength: (tool: number) => (tool === 1 ? 100 : 0), period: 0.001 };
const channel = { feed: 0, axes: [0, 1, 2], letters: "XYZ", tool: 1 } as unknown as Channel;
const state = (first: number, executed: number, rows: number[][]) =>
  ({ ...emptyState, drive: { executed }, trace: { first, axes: [0, 1, 2], rows } }) as unknown as MachineState;

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
  history.record(1, state(14, 14, [[0.2, 0, 0]]), channel);
  expect(buffer.update(history, source)).toBe("all"); // 0.1 mm in 1 ms are 6000 mm/min: another scale, every colour
  history.record(2, state(15, 15, [[0.3, 0, 0]]), channel);
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
