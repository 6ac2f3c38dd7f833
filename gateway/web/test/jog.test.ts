// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { JogHold, renewalMilliseconds } from "../src/state/jog";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function recorder(answer: () => Promise<boolean> = () => Promise.resolve(true)) {
  const sent: string[] = [];
  const hold = new JogHold({
    start: (jog) => (sent.push(`start ${jog.axis} ${jog.speed}`), answer()),
    stop: (axis) => (sent.push(`stop ${axis}`), Promise.resolve()),
  });
  return { sent, hold };
}
const continuous = { axis: 1, speed: -600, increment: 0 };

test("a held key renews until it is released", async () => {
  const { sent, hold } = recorder();
  hold.press(continuous);
  await vi.advanceTimersByTimeAsync(2 * renewalMilliseconds);
  hold.release();
  await vi.advanceTimersByTimeAsync(10 * renewalMilliseconds);
  expect(sent).toEqual(["start 1 -600", "start 1 -600", "start 1 -600", "stop 1"]);
});

test("a step is sent once and needs no stop", async () => {
  const { sent, hold } = recorder();
  hold.press({ ...continuous, increment: 0.01 });
  hold.release();
  await vi.advanceTimersByTimeAsync(10 * renewalMilliseconds);
  expect(sent).toEqual(["start 1 -600"]);
});

test("a release while the start is under way stops at once and again after its answer", async () => {
  let answer: (accepted: boolean) => void = () => {};
  const { sent, hold } = recorder(() => new Promise((resolve) => (answer = resolve)));
  hold.press(continuous);
  hold.release();
  expect(sent).toEqual(["start 1 -600", "stop 1"]);
  answer(true);
  await vi.advanceTimersByTimeAsync(1);
  expect(sent).toEqual(["start 1 -600", "stop 1", "stop 1"]);
});

test("renewals wait for the answer before them", async () => {
  const { sent, hold } = recorder(() => new Promise(() => {}));
  hold.press(continuous);
  await vi.advanceTimersByTimeAsync(20 * renewalMilliseconds);
  expect(sent).toEqual(["start 1 -600"]);
});

test("a refused jog is not renewed", async () => {
  const { sent, hold } = recorder(() => Promise.resolve(false));
  hold.press(continuous);
  await vi.advanceTimersByTimeAsync(5 * renewalMilliseconds);
  expect(sent).toEqual(["start 1 -600"]);
  expect(hold.active).toBe(false);
});

test("pressing another axis stops the first", () => {
  const { sent, hold } = recorder();
  hold.press(continuous);
  hold.press({ ...continuous, axis: 2 });
  expect(sent.slice(0, 3)).toEqual(["start 1 -600", "stop 1", "start 2 -600"]);
  hold.release();
});
