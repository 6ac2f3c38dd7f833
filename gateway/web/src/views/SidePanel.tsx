import { signal } from "@preact/signals";
import { Plots } from "./Plots";
import { ToolPath } from "./ToolPath";

const shown = signal<"path" | "plots">("path");

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
        </div>
      </div>
      {shown.value === "path" ? <ToolPath /> : <Plots />}
    </section>
  );
}
