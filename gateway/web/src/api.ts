// SPDX-License-Identifier: Apache-2.0
// The gateway's HTTP side. An answer is never thrown: a refusal is something the operator must read.
import { text } from "./text/texts";

export type { Parameter, PlcImage, ProgramEntry, Tool, WorkOffset } from "./contract";

export interface Answer<T = unknown> {
  ok: boolean;
  status: number;
  body: T | undefined;
  /** Why not, in words for the operator; empty when ok. */
  reason: string;
}

interface Refusal {
  reason?: string;
  error?: string;
  field?: string;
  alarm?: number;
}

function reasonOf(status: number, body: unknown): string {
  const refusal = (body ?? {}) as Refusal;
  const reason = refusal.reason || refusal.error || text.peek().gatewayAnswered(status);
  return refusal.alarm ? `${reason} (${text.peek().alarmNumber(refusal.alarm)})` : reason;
}

/** To an order that came by the stream. */
export interface OrderAnswer {
  answer: number;
  status: number;
  body: unknown;
}

export function answerOf<T>(status: number, body: unknown): Answer<T> {
  const ok = status >= 200 && status < 300;
  return { ok, status, body: body as T, reason: ok ? "" : reasonOf(status, body) };
}

async function call<T>(method: string, path: string, body?: BodyInit, type?: string): Promise<Answer<T>> {
  try {
    const response = await fetch(path, { method, body, headers: type ? { "Content-Type": type } : {} });
    const parsed: unknown = await response.json().catch(() => undefined);
    return answerOf<T>(response.status, parsed);
  } catch {
    return { ok: false, status: 0, body: undefined, reason: text.peek().noConnection };
  }
}

export const get = <T>(path: string) => call<T>("GET", path);
export const remove = (path: string) => call("DELETE", path);
export const post = (path: string, body: object = {}) =>
  call("POST", path, JSON.stringify(body), "application/json");
export const put = (path: string, body: object) => call("PUT", path, JSON.stringify(body), "application/json");
export const upload = (name: string, file: Blob) =>
  call("PUT", `/api/programs/${encodeURIComponent(name)}`, file, "text/plain");

export async function programBytes(name: string): Promise<Uint8Array | null> {
  try {
    const response = await fetch(`/api/programs/${encodeURIComponent(name)}`);
    return response.ok ? new Uint8Array(await response.arrayBuffer()) : null;
  } catch {
    return null;
  }
}
