// SPDX-License-Identifier: Apache-2.0
import { millimetres, whole } from "../format";
import { channel, machine } from "../state/store";

export function Technology() {
  const one = channel.value;
  if (!one) return null;
  const spindle = machine.value.drive?.spindle_speed[0];
  return (
    <section class="technology" aria-label="feed, spindle and tool">
      <div class="values digits">
        <div>
          <b>F</b>
          <span class="value">{whole(one.feed)}</span>
          <span class="dim">prog {whole(one.programmed_feed)} <span class="wide">mm/min</span></span>
        </div>
        <div>
          <b>S</b>
          <span class="value">{spindle === undefined ? "–" : whole(spindle)}</span>
          <span class="dim">prog {whole(one.spindle_programmed)} <span class="wide">1/min</span></span>
        </div>
        <div>
          <b>T</b>
          <span class="value">{one.tool}</span>
          <span class="dim">
            H{one.length_offset} · {millimetres(one.tool_length)} mm
          </span>
        </div>
      </div>
      <div class="modal" aria-label="active G codes">
        {one.modal.map((code) => (
          <span key={code}>{code}</span>
        ))}
      </div>
    </section>
  );
}
