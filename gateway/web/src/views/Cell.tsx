// SPDX-License-Identifier: Apache-2.0
// Numbers that are typed into tables.
import { useSignal } from "@preact/signals";
import type { Answer } from "../api";
import { fixed, refusal, typedNumber } from "../format";
import { tell } from "../state/store";
import { text } from "../text/texts";
import { lacking } from "./Guard";

/** Every digit that is stored: what is shown is rounded, what is edited is not. */
const exactly = (value: number) => String(value);

interface Props {
  value: number;
  /** As it is shown while it is not edited; to three decimals without it. */
  shown?: (value: number) => string;
  label: string;
  store: (value: number) => Promise<Answer>;
}

/**
 * A number that is sent when it is entered, and comes back to what is stored when it is refused. While it is being
 * edited nothing else changes it, and nothing is sent when it is left as it was.
 */
export function Cell({ value, shown = fixed, label, store }: Props) {
  const draft = useSignal<string | null>(null);
  const commit = async () => {
    const typed = draft.value;
    if (typed === null || typed === exactly(value)) {
      draft.value = null;
      return;
    }
    const entered = typedNumber(typed);
    if (entered === undefined) tell(`${label}: ${text.peek().notANumber}`, true);
    else if (entered !== value) {
      const answer = await store(entered);
      if (!answer.ok) tell(refusal(label, answer.reason), true);
    }
    draft.value = null;
  };
  return (
    <input
      class="cell digits"
      aria-label={label}
      disabled={lacking("setter") !== ""}
      title={lacking("setter") || undefined}
      value={draft.value ?? shown(value)}
      inputMode="decimal"
      onFocus={(event) => {
        const input = event.currentTarget;
        input.value = exactly(value);
        input.select();  // at once: what is typed from here on must not be selected again
        draft.value = input.value;
      }}
      onInput={(event) => {
        draft.value = event.currentTarget.value;
      }}
      onKeyDown={(event) => {
        if (event.key === "Enter") event.currentTarget.blur();
        if (event.key === "Escape") {
          event.stopPropagation();
          draft.value = null;
          event.currentTarget.blur();
        }
      }}
      onBlur={() => void commit()}
    />
  );
}
