// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { Functions } from "./Functions";
import { Plots } from "./Plots";
import { ToolPath } from "./ToolPath";

const shown = signal<"path" | "plots" | "functions">("path");

export function SidePanel() {
  return (
    <section class="side" aria-label="path and plots">
      <div class="title">
        <div class="segments small" role="tablist">
          <button role="tab" aria-selected={shown.value === "path"} onClick={() => (shown.value = "path")}>
            Tool path
          </button>
          <button
            role="tab"
            aria-selected={shown.value === "plots"}
            data-test="plots"
            onClick={() => (shown.value = "plots")}
          >
            Feed & lag
          </button>
          <button
            role="tab"
            aria-selected={shown.value === "functions"}
            data-test="functions"
            onClick={() => (shown.value = "functions")}
          >
            Functions
          </button>
        </div>
      </div>
      {shown.value === "path" ? <ToolPath /> : shown.value === "plots" ? <Plots /> : <Functions />}
    </section>
  );
}
