// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { text } from "../text/texts";
import { Functions } from "./Functions";
import { Plots } from "./Plots";
import { ToolPath } from "./ToolPath";

const shown = signal<"path" | "plots" | "functions">("path");

export function SidePanel() {
  const t = text.value;
  return (
    <section class="side" aria-label={t.pathAndPlots}>
      <div class="title">
        <div class="segments" role="tablist" aria-label={t.pathAndPlots}>
          <button role="tab" aria-selected={shown.value === "path"} data-test="path" onClick={() => (shown.value = "path")}>
            {t.toolPath}
          </button>
          <button
            role="tab"
            aria-selected={shown.value === "plots"}
            data-test="plots"
            onClick={() => (shown.value = "plots")}
          >
            {t.plots}
          </button>
          <button
            role="tab"
            aria-selected={shown.value === "functions"}
            data-test="functions"
            onClick={() => (shown.value = "functions")}
          >
            {t.functions}
          </button>
        </div>
      </div>
      {shown.value === "path" ? <ToolPath /> : shown.value === "plots" ? <Plots /> : <Functions />}
    </section>
  );
}
