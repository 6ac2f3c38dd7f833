// SPDX-License-Identifier: Apache-2.0
// The alarm strip below the state bar, in every view: how many alarms there are, the first one with its cause and
// remedy, and what leads back after a stop. Its place is always reserved, so that nothing moves when an alarm comes.
import { useSignal } from "@preact/signals";
import { explanation, wording } from "../state/alarms";
import { type Channel, holdingAlarms, type RecoveryStep, recoverySteps, sortedAlarms } from "../state/model";
import { channelList, channelName, channels, chooseChannel, commandTo, machine, notice, request, tell } from "../state/store";
import { text } from "../text/texts";
import { AlarmList } from "./Alarms";
import { AlarmWords } from "./AlarmWords";
import { lacking } from "./Guard";

const timeOut = 3000;

function titleOf(step: RecoveryStep): string {
  const t = text.value;
  if (step.kind === "release") return t.releaseEmergencyStop;
  return step.kind === "alarms" ? t.resetAlarmsStep : t.resetChannelStep(step.channel ? channelName(step.channel) : "");
}

/** Carries the steps out one after the other; false when one is refused or does not take effect. */
async function recover(): Promise<boolean> {
  const until = performance.now() + timeOut;
  let done = "";
  while (performance.now() < until) {
    const step = recoverySteps(machine.peek())[0];
    if (!step) return true;
    const title = titleOf(step);
    if (title !== done) {
      for (const path of step.paths) if (!(await request(text.peek().recovery, path))) return false;
      done = title;
    }
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  tell(text.peek().recoveryNoEffect(done), true);
  return false;
}

function Recovery({ steps }: { steps: RecoveryStep[] }) {
  const busy = useSignal(false);
  const t = text.value;
  return (
    <div class="recovery">
      <span>{steps.map(titleOf).join(", ")}</span>
      <button
        class="primary"
        data-test="recover"
        disabled={busy.value || lacking("operator") !== ""}
        onClick={() => {
          busy.value = true;
          void recover().finally(() => (busy.value = false));
        }}
      >
        {busy.value ? t.recovering : t.recover}
      </button>
    </div>
  );
}

/** Chooses the channel and searches the line; cycle start approaches it and continues. */
async function continueFromLine(one: Channel): Promise<void> {
  const t = text.peek();
  chooseChannel(one.channel);
  if (one.mode !== "AUTO" && !(await commandTo(one.channel, t.mode, "mode", { mode: "AUTO" }))) return;
  await commandTo(one.channel, t.startFromLine, "start-from-line", { line: one.restart_line });
}

function Left({ one }: { one: Channel }) {
  const t = text.value;
  return (
    <div class="recovery">
      <span>{t.leftInLine(one.program, one.restart_line)}</span>
      <button
        class="primary"
        data-test="continue-from-line"
        title={t.continueFromLineAbout}
        disabled={lacking("operator") !== ""}
        onClick={() => void continueFromLine(one)}
      >
        {t.continueFromLine(one.restart_line)}
      </button>
    </div>
  );
}

/** The answer to what the operator did. The strip has a place for it, where it lies over no key. */
function Notice() {
  const value = notice.value;
  return (
    <div class="notice-place" role="status" aria-live="polite">
      {value && (
        <div class={`notice ${value.refused ? "refused" : ""}`} title={value.text} onClick={() => (notice.value = null)}>
          {value.text}
        </div>
      )}
    </div>
  );
}

export function Attention() {
  const open = useSignal(false);
  const state = machine.value;
  const t = text.value;
  const alarms = sortedAlarms(state);
  const steps = recoverySteps(state);
  const left = channelList.value.map((number) => channels.value[String(number)]!).filter((one) => one.restart_line > 0);
  const first = alarms[0];
  const why = first && explanation(first, t);
  const says = first && wording(first, t);
  const kind = holdingAlarms(state).length > 0 || steps.length > 0 ? "bad" : first || left.length > 0 ? "warn" : "quiet";
  const listed = open.value && alarms.length > 0;
  return (
    <section class={`attention ${kind}`} aria-label={t.alarms} data-test="attention">
      <button
        class="count"
        aria-expanded={listed}
        disabled={alarms.length === 0}
        title={t.allAlarms}
        data-test="alarm-count"
        onClick={() => (open.value = !open.value)}
      >
        {alarms.length === 0 ? t.noAlarms : t.alarmCount(alarms.length)}
      </button>
      <div class="first" role="alert">
        {first && says && (
          <>
            <p class="digits" title={[says.text, says.detail].join("\n").trim()}>
              <b>{first.number}</b> <AlarmWords alarm={first} />
            </p>
            {why?.cause && <p title={why.cause}>{t.cause}: {why.cause}</p>}
            {why && <p title={why.remedy}>{t.remedy}: {why.remedy}</p>}
          </>
        )}
      </div>
      <Notice />
      {steps.length > 0 ? <Recovery steps={steps} /> : left.map((one) => <Left key={one.channel} one={one} />)}
      {listed && (
        <div class="alarm-panel alarms" tabIndex={0} aria-label={t.allAlarms} role="region">
          <AlarmList />
        </div>
      )}
    </section>
  );
}
