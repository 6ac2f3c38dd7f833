// SPDX-License-Identifier: Apache-2.0
import { afterAll, beforeAll, expect, test, vi } from "vitest";

/** A stream that is open; what the page sends is kept. */
class OpenSocket {
  static readonly OPEN = 1;
  static last: OpenSocket;
  readyState = 1;
  sent: { order: number; path: string }[] = [];
  onmessage: (event: { data: string }) => void = () => {};
  constructor() {
    OpenSocket.last = this;
  }
  send(text: string) {
    this.sent.push(JSON.parse(text));
  }
  close() {}
}

beforeAll(() => {
  vi.useFakeTimers();
  vi.stubGlobal("WebSocket", OpenSocket);
  vi.stubGlobal("location", { protocol: "http:", host: "mill:8080" });
});
afterAll(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

test("feed hold is that of every channel, by the stream", async () => {
  const { connect, holdAll } = await import("../src/state/store");
  connect();
  const channel = (number: number) => ({ channel: number, name: "", axes: [], letters: "", feed: 0, tool: 0 });
  const state = { channels: { 0: channel(0), 1: channel(1), 4: channel(4) } };
  OpenSocket.last.onmessage({ data: JSON.stringify({ sequence: 1, state }) });
  holdAll();
  expect(OpenSocket.last.sent.map((order) => order.path)).toEqual(
    [0, 1, 4].map((number) => `/api/channels/${number}/feed-hold`),
  );
});

test("a stop that the channel has not answered yet says what becomes of it", async () => {
  const { notice, stop } = await import("../src/state/store");
  const stopped = stop("Feed hold", "/api/channels/0/feed-hold");
  const reason = "feed hold is repeated until channel 0 answers";
  const { order } = OpenSocket.last.sent.at(-1)!;
  OpenSocket.last.onmessage({ data: JSON.stringify({ answer: order, status: 202, body: { accepted: true, reason } }) });
  expect(await stopped).toBe(true);
  expect(notice.value).toEqual({ text: `Feed hold: ${reason}`, refused: true });
});
