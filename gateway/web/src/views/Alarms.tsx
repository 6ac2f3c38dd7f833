// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { timeOfDay } from "../format";
import { explanation } from "../state/alarms";
import { sortedAlarms } from "../state/model";
import { machine, request } from "../state/store";
import { text } from "../text/texts";
import { AlarmHistory } from "./AlarmHistory";
import { AlarmWords } from "./AlarmWords";

export function AlarmList() {
  const t = text.value;
  const alarms = sortedAlarms(machine.value);
  return (
    <>
      <div class="title">
        <h2>{t.alarms}</h2>
        <span class={`tag ${alarms.length ? "bad" : "good"}`}>{alarms.length || t.noAlarms}</span>
        <button class="end" disabled={alarms.length === 0} onClick={() => void request(t.alarmReset, "/api/alarms/reset")}>
          {t.resetAlarms}
        </button>
      </div>
      <ul tabIndex={0} aria-label={t.alarms}>
        {alarms.map((alarm) => {
          const why = explanation(alarm, t);
          return (
            <li key={`${alarm.instance}/${alarm.number}/${alarm.part}`} class={alarm.severity.toLowerCase()}>
              <b class="digits">{alarm.number}</b>
              <span><AlarmWords alarm={alarm} /></span>
              {why && (
                <dl>
                  {why.cause && <><dt>{t.cause}</dt><dd>{why.cause}</dd></>}
                  <dt>{t.remedy}</dt><dd>{why.remedy}</dd>
                </dl>
              )}
              <span class="dim">
                {alarm.source} · {timeOfDay(alarm.since)}
                {alarm.occurrences > 1 && ` · ${t.times(alarm.occurrences)}`}
              </span>
            </li>
          );
        })}
      </ul>
    </>
  );
}

/** The active alarms, or those that there were. */
export function Alarms() {
  const past = useSignal(false);
  const t = text.value;
  return (
    <section class="alarms" aria-label={t.alarms}>
      <div class="segments" role="group" aria-label={t.alarms}>
        <button aria-pressed={!past.value} onClick={() => (past.value = false)}>{t.activeAlarms}</button>
        <button aria-pressed={past.value} onClick={() => (past.value = true)}>{t.alarmHistory}</button>
      </div>
      {past.value ? <AlarmHistory /> : <AlarmList />}
    </section>
  );
}
