// SPDX-License-Identifier: Apache-2.0
import { fixed, whole } from "../format";
import { spindleRows } from "../state/spindles";
import { channel, machine } from "../state/store";
import { text } from "../text/texts";

/** Two lines for each, whatever it does: nothing moves when a spindle begins to follow another one. */
function Spindles() {
  const t = text.value;
  const rows = spindleRows(machine.value, t);
  if (rows.length === 0) return null;
  return (
    <ul class="spindles digits" aria-label={t.spindles}>
      {rows.map(({ name, speed, condition, place, coupling }) => (
        <li key={name} data-test={`spindle-${name}`}>
          <b>{name}</b>
          <div>
            <span title={t.spindleSpeeds}>{speed}<span class="wide dim"> 1/min</span></span>
            <span>{condition}</span>
          </div>
          <div>
            <span class="dim" title={place}>{place}</span>
            {coupling && <span class={`coupling ${coupling.within ? "good-text" : "changed"}`}>{coupling.words}</span>}
          </div>
        </li>
      ))}
    </ul>
  );
}

export function Technology() {
  const one = channel.value;
  if (!one) return null;
  const t = text.value;
  const spindle = machine.value.drive?.spindle_speed[0];
  return (
    <section class="technology" aria-label={t.technology}>
      <div class="values digits">
        <div>
          <b>F</b>
          <span class="value">{whole(one.feed)}</span>
          <span class="dim">{t.programmed} {whole(one.programmed_feed)} <span class="wide">mm/min</span></span>
        </div>
        <div>
          <b>S</b>
          <span class="value">{spindle === undefined ? "–" : whole(spindle)}</span>
          <span class="dim">{t.programmed} {whole(one.spindle_programmed)} <span class="wide">1/min</span></span>
        </div>
        <div>
          <b>T</b>
          <span class="value">{one.tool}</span>
          <span class="dim">
            H{one.length_offset} · {fixed(one.tool_length)} mm
          </span>
        </div>
      </div>
      <Spindles />
      <div class="modal" role="group" aria-label={t.activeCodes}>
        <span class="dim">{t.parts} {one.parts}</span>
        {one.modal.map((code) => (
          <span key={code}>{code}</span>
        ))}
      </div>
    </section>
  );
}
