// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { History, Ring } from "../src/state/history";
import { type Channel, emptyState } from "../src/state/model";

test("a ring keeps the newest rows in order", () => {
  const ring = new Ring(3, 2);
  for (let i = 1; i <= 5; ++i) ring.push([i, 10 * i]);
  expect(ring.column(0)).toEqual([3, 4, 5]);
  expect(ring.column(1)).toEqual([30, 40, 50]);
  expect(ring.pushed).toBe(5);
});

const channel = { feed: 500, axes: [2, 0, 1], letters: "ZXY" } as unknown as Channel;
const trace = (first: number, rows: number[][]) => ({ ...emptyState, trace: { first, since: rows.map((_, i) => i), axes: [0, 1, 2], rows } });

test("the path is X, Y, Z by letter whatever the order of the axes, without points that did not move", () => {
  const history = new History();
  history.record(0, trace(1, [[1, 2, 3], [1, 2, 3], [4, 5, 6]]), channel);
  expect([0, 1, 2].map((column) => history.path.column(column))).toEqual([[1, 4], [2, 5], [3, 6]]);
});

test("rows that were left out count as time", () => {
  const history = new History();
  const rows = [[1, 0, 0], [2, 0, 0], [3, 0, 0]];
  history.record(0, { ...emptyState, trace: { first: 10, since: [0, 1, 7], axes: [0, 1, 2], rows } }, channel);
  expect(history.path.column(10)).toEqual([1, 1, 6]);
});

test("a trace that is still in the state is recorded once", () => {
  const history = new History();
  const state = trace(7, [[1, 2, 3]]);
  history.record(0, state, channel);
  history.record(0.05, { ...state, trace: { ...state.trace, rows: [[9, 9, 9]] } }, channel);
  expect(history.path.length).toBe(1);
  expect(history.samples.length).toBe(2);
});

test("the largest following error is kept by magnitude for each axis of the channel", () => {
  const history = new History();
  const axis = (following_peak: number) => ({
    commanded: 0, actual: 0, following_error: 0, following_peak, position: 0, velocity: 0, torque: 0, enabled: true,
  });
  history.record(1.5, { ...emptyState, axes: { "2": axis(-0.3), "0": axis(0.1) } }, channel);
  expect([0, 1, 2, 3, 4].map((column) => history.samples.at(0, column))).toEqual([1.5, 500, 0.3, 0.1, 0]);
});
