// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import type { Channel } from "../src/state/model";
import { RunTime } from "../src/state/run_time";

const at = (state: string, mode = "AUTO", suspended = false) => ({ state, mode, suspended }) as Channel;

test("the time of a program counts from its start to its end, holds and MDI in between included", () => {
  const time = new RunTime();
  time.observe(at("IDLE"), 1000);
  time.observe(at("RUNNING"), 1100);
  time.observe(at("HELD"), 1500);
  time.observe(at("IDLE", "MDI", true), 2000);
  time.observe(at("RUNNING"), 2600);
  expect([time.ticks, time.partial]).toEqual([1500, false]);
  time.observe(at("IDLE"), 2700);
  time.observe(at("IDLE"), 9000);
  expect(time.ticks).toBe(1500);
  time.observe(at("RUNNING", "MDI"), 9100);
  expect(time.ticks).toBe(1500);
  time.observe(at("RUNNING"), 9200);
  expect([time.ticks, time.partial]).toEqual([0, false]);
});

test("a program that ran already, or a drive that counts from zero again, gives a part of the time only", () => {
  const time = new RunTime();
  time.observe(at("RUNNING"), 500);
  time.observe(at("RUNNING"), 800);
  expect([time.ticks, time.partial]).toEqual([300, true]);
  time.observe(at("RUNNING"), 10);
  time.observe(at("RUNNING"), 50);
  expect([time.ticks, time.partial]).toEqual([40, true]);
});
