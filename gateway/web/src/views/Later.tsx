// SPDX-License-Identifier: Apache-2.0
// A view whose code is loaded when it is opened first.
import { useSignal } from "@preact/signals";
import type { ComponentType } from "preact";
import { useEffect } from "preact/hooks";
import { text } from "../text/texts";

/** `load` is always the same function for the same place. */
export function Later({ load }: { load: () => Promise<ComponentType> }) {
  const loaded = useSignal<{ View: ComponentType } | null>(null);
  const failed = useSignal(false);
  useEffect(() => {
    let ended = false;
    load().then(
      (View) => !ended && (loaded.value = { View }),
      () => !ended && (failed.value = true),
    );
    return () => {
      ended = true;
    };
  }, [load]);
  if (loaded.value) return <loaded.value.View />;
  return (
    <main class="empty">
      <p role="status">{failed.value ? text.value.viewMissing : text.value.loading}</p>
    </main>
  );
}
