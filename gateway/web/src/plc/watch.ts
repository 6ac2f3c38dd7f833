// SPDX-License-Identifier: Apache-2.0
// Live values of variables of the PLC, over a WebSocket of their own.
import { signal } from "@preact/signals";
import type { PlcVariable } from "../contract";

export interface Live {
  value: string;
  forced: boolean;
  variable: PlcVariable;
}

type Message =
  | { variables: PlcVariable[] }
  | { problem: { detail: string } }
  | { scan: number; tick: number; values: string[]; forced: number[] };

const mostWatched = 256;
const reconnectMilliseconds = 1000;

export class PlcWatch {
  /** By path. */
  readonly values = signal<ReadonlyMap<string, Live>>(new Map());
  /** Why nothing is shown; empty when all is well. */
  readonly problem = signal("");
  private socket: WebSocket | undefined;
  private paths: string[] = [];
  private variables: PlcVariable[] = [];
  private ended = false;

  constructor() {
    this.connect();
  }

  /** Watches these, at most 256 of them. */
  set(paths: readonly string[]): void {
    const wanted = [...new Set(paths)].slice(0, mostWatched);
    if (wanted.length === this.paths.length && wanted.every((path, i) => path === this.paths[i])) return;
    this.paths = wanted;
    this.ask();
  }

  close(): void {
    this.ended = true;
    this.socket?.close();
  }

  private ask(): void {
    if (this.socket?.readyState === WebSocket.OPEN && this.paths.length > 0) this.socket.send(JSON.stringify({ paths: this.paths }));
  }

  private connect(): void {
    const opened = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/plc/watch`);
    this.socket = opened;
    opened.onopen = () => this.ask();
    opened.onmessage = (event: MessageEvent<string>) => this.take(JSON.parse(event.data) as Message);
    opened.onclose = () => {
      this.values.value = new Map();
      if (!this.ended) setTimeout(() => !this.ended && this.connect(), reconnectMilliseconds);
    };
  }

  private take(message: Message): void {
    if ("problem" in message) {
      this.problem.value = message.problem.detail;
    } else if ("variables" in message) {
      this.problem.value = "";
      this.variables = message.variables;
    } else {
      const forced = new Set(message.forced);
      this.values.value = new Map(
        this.variables.map((variable, i) => [variable.path, { value: message.values[i] ?? "", forced: forced.has(i), variable }]),
      );
    }
  }
}

/** What is plotted of a value: numbers, TRUE and FALSE as 1 and 0, times in ms; NaN otherwise. */
export function plotted(value: string): number {
  if (value === "TRUE" || value === "FALSE") return value === "TRUE" ? 1 : 0;
  const time = /^L?T#(-?)(?:(\d+)d)?(?:(\d+)h)?(?:(\d+)m(?!s))?(?:(\d+(?:\.\d+)?)s)?(?:(\d+(?:\.\d+)?)ms)?/i.exec(value);
  if (time && value.includes("#")) {
    const [days, hours, minutes, seconds, milliseconds] = time.slice(2).map((part) => Number(part ?? 0));
    const all = (((days! * 24 + hours!) * 60 + minutes!) * 60 + seconds!) * 1000 + milliseconds!;
    return time[1] === "-" ? -all : all;
  }
  return value.trim() === "" ? NaN : Number(value);
}
