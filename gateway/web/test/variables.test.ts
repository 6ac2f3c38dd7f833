// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { mostRows, shownVariables } from "../src/state/variables";

test("variables are found by a part of their number", () => {
  const table = { channel: 0, numbers: [100, 101, 500, 50101], values: [1.5, -2, 0, 7] };
  expect(shownVariables(table, "").rows).toEqual([[100, 1.5], [101, -2], [500, 0], [50101, 7]]);
  expect(shownVariables(table, " #101 ").rows).toEqual([[101, -2], [50101, 7]]);
  expect(shownVariables(table, "9")).toEqual({ rows: [], more: 0 });
  expect(shownVariables(null, "")).toEqual({ rows: [], more: 0 });
});

test("of very many the first are shown and the others counted", () => {
  const numbers = Array.from({ length: 5000 }, (_, i) => 50000 + i);
  const { rows, more } = shownVariables({ channel: 0, numbers, values: numbers }, "");
  expect(rows.length).toBe(mostRows);
  expect(more).toBe(5000 - mostRows);
});
