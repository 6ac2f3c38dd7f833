// SPDX-License-Identifier: Apache-2.0
// The strip below the header, in every view: the first alarm, how many there are, and the way out of a stop.
import { useSignal } from "@preact/signals";
import { holdingAlarms, recoverySteps, sortedAlarms } from "../state/model";
import { channelList, channels, machine, request, tell, view } from "../state/store";

const patience = 3000;

/** Carries the steps out one after the other; false when one is refused or does not take effect. */
async function recover(): Promise<boolean> {
  const until = performance.now() + patience;
  let done = "";
  while (performance.now() < until) {
    const step = recoverySteps(machine.peek())[0];
    if (!step) return true;
    if (step.title !== done) {
      for (const path of step.paths) if (!(await request("Recovery", path))) return false;
      done = step.title;
    }
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  tell(`Recovery: "${done}" had no effect, its cause is still there`, true);
  return false;
}

export function Attention() {
  const busy = useSignal(false);
  const state = machine.value;
  const alarms = sortedAlarms(state);
  const steps = recoverySteps(state);
  const left = channelList.value.map((number) => channels.value[String(number)]!).filter((one) => one.restart_line > 0);
  const first = alarms[0];
  if (!first && steps.length === 0 && left.length === 0) return null;
  return (
    <div class={`attention ${holdingAlarms(state).length > 0 || steps.length > 0 ? "bad" : "warn"}`} role="alert" data-test="attention">
      {first && (
        <button class="first" title="All alarms" onClick={() => (view.value = "operate")}>
          <b class="digits">{alarms.length > 1 ? `${alarms.length} alarms` : "1 alarm"}</b>
          <span>
            <b class="digits">{first.number}</b> {first.text}
          </span>
        </button>
      )}
      {!first && steps.length === 0 && left.map((one) => (
        <span key={one.channel}>
          {one.program} was left in line <b class="digits">{one.restart_line}</b>: start from a line continues there.
        </span>
      ))}
      {steps.length > 0 && (
        <div class="recovery">
          <span>{steps.map((step) => step.title).join(", ")}</span>
          <button
            class="primary"
            data-test="recover"
            disabled={busy.value}
            onClick={() => {
              busy.value = true;
              void recover().finally(() => (busy.value = false));
            }}
          >
            {busy.value ? "Recovering…" : "Recover"}
          </button>
        </div>
      )}
    </div>
  );
}
