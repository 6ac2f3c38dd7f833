// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { refusal } from "../format";
import { tell } from "../state/store";
import { changes, undoLast } from "../state/undo";
import { text } from "../text/texts";
import { lacking } from "./Guard";

/** The key that takes the last change of this page back. */
export function UndoKey() {
  const busy = useSignal(false);
  const last = changes.value[changes.value.length - 1];
  const t = text.value;
  return (
    <button
      class="undo"
      disabled={!last || busy.value || lacking("setter") !== ""}
      title={last?.what}
      onClick={() => {
        busy.value = true;
        void undoLast().then((answer) => {
          busy.value = false;
          if (answer) tell(answer.ok ? t.undone(last!.what) : refusal(t.undo, answer.reason), !answer.ok);
        });
      }}
    >
      {last ? t.undoOf(last.what) : t.undo}
    </button>
  );
}
