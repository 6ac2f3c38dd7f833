// SPDX-License-Identifier: Apache-2.0
// What is set before a part is made: tools, work offsets and tilted planes, with an undo of the changes of this page; and
// the measurements of the workpiece and of the kinematics.
import { signal } from "@preact/signals";
import { text } from "../text/texts";
import { GuardNote } from "./Guard";
import { Later } from "./Later";
import { Planes } from "./Planes";
import { Tools } from "./Tools";
import { UndoKey } from "./UndoKey";
import { WorkOffsets } from "./WorkOffsets";

const shown = signal<"offsets" | "tools" | "planes" | "measure" | "kinematics" | "manual">("offsets");
const loadKinematics = () => import("./Kinematics").then(({ Kinematics }) => Kinematics);
const loadManual = () => import("./ManualCalibration").then(({ ManualCalibration }) => ManualCalibration);
const loadMeasuring = () => import("./MeasuringCycles").then(({ MeasuringCycles }) => MeasuringCycles);

export function Setup() {
  const t = text.value;
  return (
    <main class="setup">
      <section class="setup-keys" aria-label={t.setup}>
        <div class="segments" role="tablist" aria-label={t.setup}>
          {([["offsets", t.workOffsets], ["tools", t.tools], ["planes", t.planes], ["measure", t.measure], ["kinematics", t.kinematics], ["manual", t.manualCalibration]] as const).map(([name, title]) => (
            <button key={name} role="tab" aria-selected={shown.value === name} onClick={() => (shown.value = name)}>{title}</button>
          ))}
        </div>
        {["offsets", "tools", "planes"].includes(shown.value) && <UndoKey />}
        <GuardNote needs="setter" />
      </section>
      {shown.value === "offsets" && <WorkOffsets />}
      {shown.value === "tools" && <Tools />}
      {shown.value === "planes" && <Planes />}
      {shown.value === "measure" && <Later part load={loadMeasuring} />}
      {shown.value === "kinematics" && <Later part load={loadKinematics} />}
      {shown.value === "manual" && <Later part load={loadManual} />}
    </main>
  );
}
