// SPDX-License-Identifier: Apache-2.0
import { timeOfDay } from "../format";
import { explanation } from "../state/alarms";
import { sortedAlarms } from "../state/model";
import { machine, request } from "../state/store";
import { text } from "../text/texts";

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
      <ul>
        {alarms.map((alarm) => {
          const why = explanation(alarm, t);
          return (
            <li key={`${alarm.instance}/${alarm.number}/${alarm.part}`} class={alarm.severity.toLowerCase()}>
              <b class="digits">{alarm.number}</b>
              <span>{alarm.text}</span>
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

export function Alarms() {
  return (
    <section class="alarms" aria-label={text.value.alarms}>
      <AlarmList />
    </section>
  );
}
