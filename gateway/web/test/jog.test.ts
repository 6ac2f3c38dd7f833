// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { JogHold, renewalMilliseconds } from "../src/state/jog";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function recorder(answer: () => Promise<boolean> = () => Promise.resolve(true)) {
  const sent: string[] = [], presses: number[] = [];
  const hold = new JogHold({
    start: (jog, press) => (sent.push(`start ${jog.axis} ${jog.speed}`), presses.push(press), answer()),
    renew: (press) => (sent.push("renew"), presses.push(press), answer()),
    stop: (axis) => (sent.push(`stop ${axis}`), Promise.resolve()),
  });
  return { sent, presses, hold };
}
const continuous = { axis: 1, speed: -600, increment: 0 };

test("a held key renews its press until it is released", async () => {
  const { sent, presses, hold } = recorder();
  hold.press(continuous);
  await vi.advanceTimersByTimeAsync(2 * renewalMilliseconds);
  hold.release();
  await vi.advanceTimersByTimeAsync(10 * renewalMilliseconds);
  expect(sent).toEqual(["start 1 -600", "renew", "renew", "stop 1"]);
  expect(new Set(presses).size).toBe(1);
});

test("two presses have two numbers", () => {
  const { presses, hold } = recorder();
  hold.press(continuous);
  hold.press(continuous);
  hold.release();
  expect(presses[0]).not.toBe(presses[1]);
  expect(Math.min(...presses)).toBeGreaterThan(0);
});

test("a step is sent once and needs no stop", async () => {
  const { sent, hold } = recorder();
  hold.press({ ...continuous, increment: 0.01 });
  hold.release();
  await vi.advanceTimersByTimeAsync(10 * renewalMilliseconds);
  expect(sent).toEqual(["start 1 -600"]);
});

test("renewals wait for the answer before them", async () => {
  const { sent, hold } = recorder(() => new Promise(() => {}));
  hold.press(continuous);
  await vi.advanceTimersByTimeAsync(20 * renewalMilliseconds);
  expect(sent).toEqual(["start 1 -600"]);
});

test("a refused jog is not renewed, and a press that ended elsewhere is over", async () => {
  for (const accepted of [[false], [true, true, false]]) {
    const { sent, hold } = recorder(() => Promise.resolve(accepted.shift() ?? false));
    const expected = accepted.length;
    hold.press(continuous);
    await vi.advanceTimersByTimeAsync(9 * renewalMilliseconds);
    expect(sent.length).toBe(expected);
    expect(hold.active).toBe(false);
  }
});

test("pressing another axis stops the first", () => {
  const { sent, hold } = recorder();
  hold.press(continuous);
  hold.press({ ...continuous, axis: 2 });
  expect(sent.slice(0, 3)).toEqual(["start 1 -600", "stop 1", "start 2 -600"]);
  hold.release();
});
