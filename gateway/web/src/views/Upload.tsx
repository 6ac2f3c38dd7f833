// SPDX-License-Identifier: Apache-2.0
import { useRef } from "preact/hooks";
import { uploadFile } from "../state/programs";
import { text } from "../text/texts";
import { lackingToStore } from "./Guard";

/** A button that stores a chosen file as a program; a name that exists is asked about. */
export function Upload() {
  const file = useRef<HTMLInputElement>(null);
  const t = text.value;
  return (
    <>
      <button disabled={lackingToStore() !== ""} title={lackingToStore() || undefined} onClick={() => file.current?.click()}>{t.upload}</button>
      <input
        ref={file}
        type="file"
        hidden
        aria-label={t.upload}
        onChange={(event) => {
          const chosen = event.currentTarget.files?.[0];
          if (chosen) void uploadFile(chosen);
          event.currentTarget.value = "";
        }}
      />
    </>
  );
}
