// SPDX-License-Identifier: Apache-2.0
// What is done with the programs of the PLC beside watching them, one at a time.
import { signal } from "@preact/signals";
import { text } from "../text/texts";
import { PlcTasks } from "./PlcTasks";
import { PlcTrace } from "./PlcTrace";

const tools = ["trace", "tasks"] as const;
type Tool = (typeof tools)[number];

const tool = signal<Tool>("trace");

export function PlcTools({ paths }: { paths: readonly string[] }) {
  const t = text.value;
  const names: Record<Tool, string> = { trace: t.plcTrace, tasks: t.plcTasks };
  return (
    <section class="plc-tools" aria-label={names[tool.value]}>
      <div class="segments" role="group" aria-label={t.plcTools}>
        {tools.map((name) => (
          <button key={name} aria-pressed={tool.value === name} onClick={() => (tool.value = name)}>{names[name]}</button>
        ))}
      </div>
      {tool.value === "trace" && <PlcTrace paths={paths} />}
      {tool.value === "tasks" && <PlcTasks />}
    </section>
  );
}
