// SPDX-License-Identifier: Apache-2.0
// The alarms that there were, newest first; asked for anew when an alarm comes or goes.
import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get } from "../api";
import type { PastAlarm } from "../contract";
import { dateAndTime, duration } from "../format";
import { machine } from "../state/store";
import { text } from "../text/texts";
import { AlarmWords } from "./AlarmWords";

const search = signal("");
const shown = 100;

/** Seconds that an alarm was active; undefined while it is. */
function seconds(alarm: PastAlarm): number | undefined {
  return alarm.cleared === undefined ? undefined : Math.max(0, (Date.parse(alarm.cleared) - Date.parse(alarm.raised)) / 1000);
}

export function AlarmHistory() {
  const rows = useSignal<PastAlarm[]>([]);
  const missing = useSignal("");
  const most = useSignal(shown);
  const active = Object.keys(machine.value.alarms ?? {}).sort().join();
  useEffect(() => {
    let asked = true;
    const timer = setTimeout(async () => {
      const answer = await get<{ alarms: PastAlarm[] }>(`/api/alarms/history?limit=${most.value + 1}&search=${encodeURIComponent(search.value)}`);
      if (!asked) return;
      missing.value = answer.ok ? "" : answer.reason;
      if (answer.ok && answer.body) rows.value = answer.body.alarms;
    }, 200);
    return () => {
      asked = false;
      clearTimeout(timer);
    };
  }, [active, search.value, most.value]);
  const t = text.value;
  return (
    <>
      <input
        type="search"
        aria-label={t.searchAlarms}
        placeholder={t.searchAlarms}
        value={search.value}
        onInput={(event) => (search.value = event.currentTarget.value)}
      />
      {missing.value && <p class="dim" role="status">{missing.value}</p>}
      <div class="scroll" tabIndex={0} role="region" aria-label={t.alarmHistory}>
        <ul data-test="alarm-history">
          {rows.value.slice(0, most.value).map((alarm) => {
            const lasted = seconds(alarm);
            return (
              <li key={`${alarm.raised}/${alarm.instance}/${alarm.number}/${alarm.part}`} class={alarm.severity.toLowerCase()}>
                <b class="digits">{alarm.number}</b>
                <span><AlarmWords alarm={alarm} /></span>
                <span class="dim digits">
                  {dateAndTime(alarm.raised)} · {lasted === undefined ? t.stillActive : t.lasted(duration(lasted))} · {alarm.source}
                  {alarm.occurrences > 1 && ` · ${t.times(alarm.occurrences)}`}
                </span>
              </li>
            );
          })}
        </ul>
        {rows.value.length === 0 && !missing.value && <p class="dim">{t.noPastAlarms}</p>}
        {rows.value.length > most.value && <button onClick={() => (most.value += shown)}>{t.moreAlarms}</button>}
      </div>
    </>
  );
}
