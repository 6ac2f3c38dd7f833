// SPDX-License-Identifier: Apache-2.0
// A question beside the work, not over it: the machine can be held and stopped while it waits for an answer.
import { signal } from "@preact/signals";
import { text } from "../text/texts";

interface Pending {
  question: string;
  /** The key that agrees. */
  yes: string;
  agreed: () => void;
}

const pending = signal<Pending | null>(null);

/** Replaces a question that is not answered yet. */
export function ask(question: string, yes: string, agreed: () => void): void {
  pending.value = { question, yes, agreed };
}

export function Question() {
  const one = pending.value;
  if (!one) return null;
  return (
    <div class="question" role="alertdialog" aria-label={one.question}>
      <p>{one.question}</p>
      <button
        class="primary"
        onClick={() => {
          pending.value = null;
          one.agreed();
        }}
      >
        {one.yes}
      </button>
      <button onClick={() => (pending.value = null)}>{text.value.cancel}</button>
    </div>
  );
}
