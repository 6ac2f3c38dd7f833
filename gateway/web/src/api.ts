// SPDX-License-Identifier: Apache-2.0
// The gateway's HTTP side. An answer is never thrown: a refusal is something the operator must read.
import type { ProgramCheck, Stored } from "./contract";
import { text } from "./text/texts";

export type { Parameter, PlcImage, ProgramEntry, Tool, WorkOffset } from "./contract";

export interface Answer<T = unknown> {
  ok: boolean;
  status: number;
  body: T | undefined;
  /** Why not, or what is still to come of it, in words for the operator; empty when it is done. */
  reason: string;
  /** ETag of what was read, for putIfSame(). */
  tag?: string;
}

interface Refusal {
  reason?: string;
  error?: string;
  /** Of problem details (RFC 9457). */
  detail?: string;
  field?: string;
  alarm?: number;
}

function reasonOf(status: number, body: unknown): string {
  const refusal = (body ?? {}) as Refusal;
  const reason = refusal.reason || refusal.detail || refusal.error || text.peek().gatewayAnswered(status);
  return refusal.alarm ? `${reason} (${text.peek().alarmNumber(refusal.alarm)})` : reason;
}

/** To an order that came by the stream. */
export interface OrderAnswer {
  answer: number;
  status: number;
  body: unknown;
}

/** To a stop that the gateway repeats because the channel does not answer. */
const stillUnanswered = 202;

export function answerOf<T>(status: number, body: unknown): Answer<T> {
  const ok = status >= 200 && status < 300;
  return { ok, status, body: body as T, reason: ok && status !== stillUnanswered ? "" : reasonOf(status, body) };
}

/** Called when the gateway says that nobody is logged in. */
let onUnknown = (): void => undefined;
export function whenUnknown(act: () => void): void {
  onUnknown = act;
}

/** An order is answered when what follows from it is shown. */
let shown = (_sequence: number): Promise<void> => Promise.resolve();
export function waitUntilShown(until: (sequence: number) => Promise<void>): void {
  shown = until;
}

async function call<T>(
  method: string, path: string, body?: BodyInit, type?: string, more: Record<string, string> = {},
): Promise<Answer<T>> {
  try {
    const response = await fetch(path, { method, body, headers: type ? { "Content-Type": type, ...more } : more });
    const parsed: unknown = await response.json().catch(() => undefined);
    if (response.status === 401) onUnknown();
    if (method !== "GET") await shown(Number(response.headers.get("X-State-Sequence") ?? 0));
    return { ...answerOf<T>(response.status, parsed), tag: response.headers.get("ETag") ?? "" };
  } catch {
    return { ok: false, status: 0, body: undefined, reason: text.peek().noConnection };
  }
}

export const get = <T>(path: string) => call<T>("GET", path);
export const remove = (path: string, headers: Record<string, string> = {}) => call("DELETE", path, undefined, undefined, headers);
export const post = <T = unknown>(path: string, body: object = {}) =>
  call<T>("POST", path, JSON.stringify(body), "application/json");
export const put = (path: string, body: object) => call("PUT", path, JSON.stringify(body), "application/json");
/** Status 412, and nothing is changed, when what had this tag has been changed since. */
export const putIfSame = (path: string, body: object, tag = "") =>
  call("PUT", path, JSON.stringify(body), "application/json", tag ? { "If-Match": tag } : {});
export const upload = (name: string, file: Blob) =>
  call("PUT", `/api/programs/${encodeURIComponent(name)}`, file, "text/plain");

/** Stores a text in place of `revision`, 0 = where no program is; status 412 when another one is stored. */
export const storeProgram = (name: string, content: string, revision: number) =>
  call<Stored>("PUT", `/api/programs/${encodeURIComponent(name)}`, content, "text/plain",
    revision > 0 ? { "If-Match": `"${revision}"` } : { "If-None-Match": "*" });
/** `name`: under which the text is or will be stored. */
export const checkProgram = (channel: number, content: string, name: string) =>
  call<ProgramCheck>("POST", `/api/check/${channel}?name=${encodeURIComponent(name)}`, content, "text/plain");

export interface StoredText {
  revision: number;
  /** Null: it is not UTF-8. */
  text: string | null;
}

/** The text of a program and its revision; nothing when it cannot be read. */
export async function programText(name: string): Promise<StoredText | null> {
  try {
    const response = await fetch(`/api/programs/${encodeURIComponent(name)}`);
    if (!response.ok) return null;
    return { revision: Number(response.headers.get("X-Program-Revision")), text: utf8(await response.arrayBuffer()) };
  } catch {
    return null;
  }
}

/** Null where the bytes are no UTF-8: they would be stored as others. */
export function utf8(bytes: ArrayBuffer): string | null {
  try {
    return new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(bytes);
  } catch {
    return null;
  }
}

export async function programBytes(name: string): Promise<Uint8Array | null> {
  try {
    const response = await fetch(`/api/programs/${encodeURIComponent(name)}`);
    return response.ok ? new Uint8Array(await response.arrayBuffer()) : null;
  } catch {
    return null;
  }
}
