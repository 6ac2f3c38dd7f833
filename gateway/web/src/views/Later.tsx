// SPDX-License-Identifier: Apache-2.0
// A view whose code is loaded when it is opened first.
import { useSignal } from "@preact/signals";
import type { ComponentType } from "preact";
import { useEffect } from "preact/hooks";
import { text } from "../text/texts";

/** `load` is always the same function for the same place; `part`: inside a view, which is the main part of the page. */
export function Later({ load, part = false }: { load: () => Promise<ComponentType>; part?: boolean }) {
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
  const said = <p role="status">{failed.value ? text.value.viewMissing : text.value.loading}</p>;
  return part ? <section>{said}</section> : <main class="empty">{said}</main>;
}
