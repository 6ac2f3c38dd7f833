// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { LifeUnit, RunState } from "../src/contract";
import { placeOf, placesOf, tableOf, tableParameter } from "../src/state/magazine";
import { changeLine, mayChange } from "../src/state/tool_change";
import { isUsedUp, lifeText } from "../src/state/tool_life";
import { languages } from "../src/text/texts";

test("a tool is changed by the line that an operator types", () => {
  expect(changeLine(12)).toBe("T12 M6");
});

test("a tool is changed only while the channel is at rest and no program is held", () => {
  const busy: RunState[] = ["RUNNING", "HOLDING", "HELD", "WAITING", "INTERRUPTED"];
  expect(mayChange({ state: "IDLE", suspended: false })).toBe(true);
  expect(mayChange({ state: "IDLE", suspended: true })).toBe(false);
  for (const state of busy) expect(mayChange({ state, suspended: false }), state).toBe(false);
});

test("the delivered magazine belongs to channel 0; another one is named", () => {
  expect(tableParameter(3)).toBe(43958);
  expect(tableOf(0, "")).toBe("main.changer.tools");
  expect(tableOf(1, " ")).toBe("");
  expect(tableOf(1, "second.chain.tools")).toBe("second.chain.tools");
});

test("a tool has the place that the PLC's table gives it", () => {
  // T3 in the spindle, place 1 empty, T12 in place 2; a T number twice is where it is found first.
  const table = new Map([["t[0]", "3"], ["t[1]", "0"], ["t[2]", "12"], ["t[3]", "12"], ["t", "7"]].map(([path, value]) => [path!, { value: value! }]));
  const places = placesOf(table);
  expect([...places]).toEqual([[3, 0], [12, 2]]);
  expect([3, 12, 7].map((tool) => placeOf(tool, 7, places))).toEqual([0, 2, undefined]);
});

test("without a table only the tool in the spindle has a place", () => {
  expect([3, 7].map((tool) => placeOf(tool, 7, placesOf(new Map())))).toEqual([undefined, 0]);
});

test("the life has its limit and unit, and a tool that has reached it is known", () => {
  const life = (life_used: number, life_limit: number, life_unit: LifeUnit = "MINUTES") => ({ life_used, life_limit, life_unit });
  expect(lifeText(life(0, 0), languages.en)).toBe("–");
  expect(lifeText(life(12.54, 90), languages.en)).toBe("12.5 / 90 min");
  expect(lifeText(life(7, 0, "PIECES"), languages.en)).toBe("7 pieces");
  expect(lifeText(life(0, 200, "PIECES"), languages.de)).toBe("0 / 200 Stück");
  expect([life(89.9, 90), life(90, 90), life(91, 90), life(5, 0), life(0, 0)].map(isUsedUp)).toEqual([false, true, true, false, false]);
});
