// SPDX-License-Identifier: Apache-2.0
// The one place with live state: the stream, the chosen channel and view, and the last thing that was refused.
import { computed, signal } from "@preact/signals";
import { type Answer, answerOf, type OrderAnswer, post, waitUntilShown } from "../api";
import type { ChannelCommands } from "../contract";
import { refusal } from "../format";
import { text } from "../text/texts";
import { History } from "./history";
import { channelNumbers, emptyStream, type Message, receive, type Stream } from "./model";
import { Shown } from "./shown";

const stream = signal<Stream>(emptyStream);
export const machine = computed(() => stream.value.state);
const shown = new Shown();
waitUntilShown((sequence) => shown.until(sequence));

/** connecting: never heard of the gateway; lost: what is shown is old. */
export const connection = signal<"connecting" | "live" | "lost">("connecting");

export type ViewName = "operate" | "scene" | "programs" | "setup" | "parameters" | "analysis" | "diagnosis";
export const view = signal<ViewName>("operate");

const chosenChannel = signal<number | null>(null);
export const channels = computed(() => machine.value.channels);
export const channelList = computed(() => channelNumbers(machine.value));
export const channelNumber = computed(() => {
  const chosen = chosenChannel.value;
  return chosen !== null && channelList.value.includes(chosen) ? chosen : (channelList.value[0] ?? null);
});
export const channel = computed(() => {
  const number = channelNumber.value;
  return number === null ? undefined : channels.value[String(number)];
});

const histories = new Map<number, History>();
export function history(number: number): History {
  const known = histories.get(number);
  if (known) return known;
  const fresh = new History();
  histories.set(number, fresh);
  return fresh;
}

/** The channel's name, or its number in words. */
export function channelName(one: { channel: number; name: string }): string {
  return one.name || text.value.channelNumber(one.channel);
}

export function chooseChannel(number: number): void {
  chosenChannel.value = number;
}

export interface Notice {
  text: string;
  refused: boolean;
}
export const notice = signal<Notice | null>(null);
let noticeTimer: ReturnType<typeof setTimeout> | undefined;

export function tell(text: string, refused: boolean): void {
  notice.value = { text, refused };
  clearTimeout(noticeTimer);
  noticeTimer = setTimeout(() => (notice.value = null), refused ? 12000 : 4000);
}

// What was told is about the view in which it was done.
view.subscribe(() => {
  notice.value = null;
});

/** Sends a request and shows the refusal, if there is one; true when accepted. */
export async function request(what: string, path: string, body: object = {}): Promise<boolean> {
  const answer = await post(path, body);
  if (answer.ok) {
    if (notice.value?.refused) notice.value = null;
  } else {
    tell(refusal(what, answer.reason), true);
  }
  return answer.ok;
}

let socket: WebSocket | undefined;
let orders = 0;
const orderMilliseconds = 400;
const answers = new Map<number, (answer: Answer) => void>();

/** By the stream, which needs no new connection; nothing when it is not open or does not answer in time. */
function byStream(path: string, body: object): Promise<Answer | undefined> {
  if (socket?.readyState !== WebSocket.OPEN) return Promise.resolve(undefined);
  const order = ++orders;
  socket.send(JSON.stringify({ order, path, body }));
  return new Promise((resolve) => {
    const late = setTimeout(() => {
      answers.delete(order);
      resolve(undefined);
    }, orderMilliseconds);
    answers.set(order, (answer) => {
      clearTimeout(late);
      resolve(answer);
    });
  });
}

/** A request that stops something: by the stream, and over HTTP when that does not answer. */
export async function stop(what: string, path: string, body: object = {}): Promise<boolean> {
  const answer = (await byStream(path, body)) ?? (await post(path, body));
  if (answer.reason) tell(refusal(what, answer.reason), true);
  return answer.ok;
}

/** Feed hold of every channel: pressed in haste, it means the machine and not the channel that is shown. */
export function holdAll(): void {
  const list = channelList.peek();
  for (const number of list.length > 0 ? list : [0]) void stop(text.peek().feedHold, `/api/channels/${number}/feed-hold`);
}

/** False when the press has ended; the operator sees the axis stop, so nothing is told. */
export async function renewJog(channel: number, press: number): Promise<boolean> {
  const path = `/api/channels/${channel}/jog-renew`;
  return ((await byStream(path, { press })) ?? (await post(path, { press }))).ok;
}

/** A command to a channel; `what` names it for the operator when it is refused. */
export function commandTo<Route extends keyof ChannelCommands>(
  channel: number, what: string, route: Route, body: ChannelCommands[Route],
): Promise<boolean> {
  return request(what, `/api/channels/${channel}/${route}`, body);
}

/** A command to the chosen channel. */
export function command<Route extends keyof ChannelCommands>(
  what: string, route: Route, body: ChannelCommands[Route],
): Promise<boolean> {
  const number = channelNumber.value;
  return number === null ? Promise.resolve(false) : commandTo(number, what, route, body);
}

// The gateway sends something every 0.3 s at the latest, so silence of this length means that it is gone.
const silenceMilliseconds = 900;
// Of these the last part counts with an idle page only: what came while it was busy is heard first.
const idleMilliseconds = 200;
const connectMilliseconds = 5000;
const reconnectMilliseconds = 700;

/** Connects and keeps connecting for as long as the page lives. */
export function connect(): void {
  let silence: ReturnType<typeof setTimeout> | undefined;
  const opened = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/stream`);
  socket = opened;
  let ended = false;
  const end = () => {
    if (ended) return;
    ended = true;
    shown.ended();
    clearTimeout(silence);
    opened.close();
    if (connection.value === "live") connection.value = "lost";
    setTimeout(connect, reconnectMilliseconds);
  };
  const heard = (quiet = silenceMilliseconds) => {
    clearTimeout(silence);
    silence = setTimeout(() => (silence = setTimeout(end, idleMilliseconds)), quiet - idleMilliseconds);
  };
  heard(connectMilliseconds);
  opened.onmessage = (event: MessageEvent<string>) => {
    const message = JSON.parse(event.data) as Message | OrderAnswer;
    if ("answer" in message) {
      answers.get(message.answer)?.(answerOf(message.status, message.body));
      answers.delete(message.answer);
      return heard();
    }
    const next = receive(stream.value, message);
    if (!next) return end();
    heard();
    stream.value = next;
    connection.value = "live";
    const now = performance.now() / 1000;
    for (const one of Object.values(next.state.channels)) {
      if ("state" in message) history(one.channel).interrupt();
      history(one.channel).record(now, next.state, one);
    }
    shown.shows(next.sequence, "state" in message);
  };
  opened.onclose = end;
  opened.onerror = end;
}
