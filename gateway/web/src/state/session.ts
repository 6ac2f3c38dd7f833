// SPDX-License-Identifier: Apache-2.0
// Who is logged in, as the gateway says.
import { signal } from "@preact/signals";
import { get, post, remove, whenUnknown } from "../api";
import type { Session } from "../contract";

/** Null before the gateway has answered. */
export const session = signal<Session | null>(null);

/** Somebody was logged in at this page, and is not any more. */
export const sessionOver = signal(false);

export async function askSession(): Promise<void> {
  const answer = await get<Session>("/api/session");
  if (!answer.ok || !answer.body) return;
  if (answer.body.name !== "") sessionOver.value = false;
  else if (session.peek()?.name) sessionOver.value = true;
  session.value = answer.body;
}

whenUnknown(() => void askSession());

/** Empty, or why not. */
export async function logIn(name: string, password: string): Promise<string> {
  const answer = await post("/api/session", { name, password });
  if (answer.ok) await askSession();
  return answer.reason;
}

export async function logOut(): Promise<void> {
  await remove("/api/session");
  location.reload();
}

/** Whether the page has nothing to show before a login. */
export const mustLogIn = () => session.value !== null && session.value.auth && session.value.name === "";
