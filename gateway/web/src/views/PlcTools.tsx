// SPDX-License-Identifier: Apache-2.0
// What is done with the programs of the PLC beside watching them, one at a time.
import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { PlcPrograms } from "../contract";
import { runningSources } from "../plc/load";
import type { Source } from "../plc/source";
import type { Live } from "../plc/watch";
import { text } from "../text/texts";
import { PlcSimulator } from "./PlcSimulator";
import { PlcTasks } from "./PlcTasks";
import { PlcTrace } from "./PlcTrace";
import { PlcUses } from "./PlcUses";

const tools = ["trace", "tasks", "uses", "simulator"] as const;
type Tool = (typeof tools)[number];

const tool = signal<Tool>("trace");

interface Props {
  /** The watched variables. */
  chosen: readonly string[];
  programs: PlcPrograms;
  /** The paths of all variables. */
  all: readonly string[];
  live: ReadonlyMap<string, Live>;
  watch: (paths: string[]) => void;
}

export function PlcTools({ chosen, programs, all, live, watch }: Props) {
  const t = text.value;
  const sources = useSignal<Source[]>([]);
  useEffect(() => void runningSources(programs).then((found) => (sources.value = found)), [programs.crc32, programs.changes]);
  const names: Record<Tool, string> = { trace: t.plcTrace, tasks: t.plcTasks, uses: t.plcUses, simulator: t.plcSimulator };
  return (
    <section class="plc-tools" aria-label={names[tool.value]}>
      <div class="segments" role="group" aria-label={t.plcTools}>
        {tools.map((name) => (
          <button key={name} aria-pressed={tool.value === name} onClick={() => (tool.value = name)}>{names[name]}</button>
        ))}
      </div>
      {tool.value === "trace" && <PlcTrace paths={chosen} />}
      {tool.value === "tasks" && <PlcTasks />}
      {tool.value === "uses" && <PlcUses chosen={chosen} sources={sources.value} version={`${programs.crc32} ${programs.changes}`} />}
      {tool.value === "simulator" && <PlcSimulator sources={sources.value} all={all} live={live} watch={watch} />}
    </section>
  );
}
