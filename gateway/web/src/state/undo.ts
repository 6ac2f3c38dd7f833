// SPDX-License-Identifier: Apache-2.0
// What was changed on this page, to be taken back one after the other. Each change takes itself back only while what it
// stored is still there.
import { signal } from "@preact/signals";
import type { Answer } from "../api";
import { text } from "../text/texts";

export interface Change {
  /** For the operator: what, from what to what. */
  what: string;
  undo: () => Promise<Answer>;
}

const most = 30;
export const changes = signal<Change[]>([]);

export function remember(change: Change): void {
  changes.value = [...changes.peek(), change].slice(-most);
}

/** The newest change; it stays when it is refused. */
export async function undoLast(): Promise<Answer | undefined> {
  const last = changes.peek()[changes.peek().length - 1];
  if (!last) return undefined;
  const answer = await last.undo();
  if (answer.ok) changes.value = changes.peek().filter((one) => one !== last);
  return answer;
}

/** Instead of an undo whose subject has been changed by someone else. */
export const changedSince = (): Answer => ({ ok: false, status: 409, body: undefined, reason: text.peek().changedSince });
