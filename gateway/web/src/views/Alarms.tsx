// SPDX-License-Identifier: Apache-2.0
import { timeOfDay } from "../format";
import { sortedAlarms } from "../state/model";
import { machine, request } from "../state/store";

export function Alarms() {
  const alarms = sortedAlarms(machine.value);
  return (
    <section class="alarms" aria-label="alarms">
      <div class="title">
        <h2>Alarms</h2>
        <span class={`tag ${alarms.length ? "bad" : "good"}`}>{alarms.length || "none"}</span>
        <button
          class="end"
          disabled={alarms.length === 0}
          onClick={() => void request("Alarm reset", "/api/alarms/reset")}
        >
          Reset alarms
        </button>
      </div>
      <ul>
        {alarms.map((alarm) => (
          <li key={`${alarm.instance}/${alarm.number}/${alarm.part}`} class={alarm.severity.toLowerCase()}>
            <b class="digits">{alarm.number}</b>
            <span>{alarm.text}</span>
            <span class="dim">
              {alarm.source} · {timeOfDay(alarm.since)}
              {alarm.occurrences > 1 && ` · ${alarm.occurrences} times`}
            </span>
          </li>
        ))}
      </ul>
    </section>
  );
}
