// SPDX-License-Identifier: Apache-2.0
// What is set before a part is made: tools, work offsets and tilted planes, with an undo of the changes of this page.
import { signal } from "@preact/signals";
import { text } from "../text/texts";
import { GuardNote } from "./Guard";
import { Planes } from "./Planes";
import { Tools } from "./Tools";
import { UndoKey } from "./UndoKey";
import { WorkOffsets } from "./WorkOffsets";

const shown = signal<"offsets" | "tools" | "planes">("offsets");

export function Setup() {
  const t = text.value;
  return (
    <main class="setup">
      <section class="setup-keys" aria-label={t.setup}>
        <div class="segments" role="tablist" aria-label={t.setup}>
          {([["offsets", t.workOffsets], ["tools", t.tools], ["planes", t.planes]] as const).map(([name, title]) => (
            <button key={name} role="tab" aria-selected={shown.value === name} onClick={() => (shown.value = name)}>{title}</button>
          ))}
        </div>
        <UndoKey />
        <GuardNote needs="setter" />
      </section>
      {shown.value === "offsets" ? <WorkOffsets /> : shown.value === "tools" ? <Tools /> : <Planes />}
    </main>
  );
}
