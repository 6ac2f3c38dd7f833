// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { text } from "../text/texts";
import { Functions } from "./Functions";
import { Plots } from "./Plots";
import { ToolPath } from "./ToolPath";
import { Variables } from "./Variables";

const shown = signal<"path" | "plots" | "functions" | "variables">("path");

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
          <button
            role="tab"
            aria-selected={shown.value === "variables"}
            data-test="variables"
            onClick={() => (shown.value = "variables")}
          >
            {t.variables}
          </button>
        </div>
      </div>
      {shown.value === "path" && <ToolPath />}
      {shown.value === "plots" && <Plots />}
      {shown.value === "functions" && <Functions />}
      {shown.value === "variables" && <Variables />}
    </section>
  );
}
