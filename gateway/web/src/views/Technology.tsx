// SPDX-License-Identifier: Apache-2.0
import type { SpindleCondition, SpindleShown } from "../contract";
import { fixed, whole } from "../format";
import { channel, machine } from "../state/store";
import { text } from "../text/texts";

function SpindleState({ spindle }: { spindle: SpindleShown }) {
  const t = text.value;
  const conditions: Record<SpindleCondition, string> = {
    SPINDLE_STOPPED: t.spindleStopped,
    SPINDLE_ACCELERATING: t.spindleAccelerating,
    SPINDLE_AT_SPEED: t.spindleAtSpeed,
    SPINDLE_POSITIONING: t.spindlePositioning,
    SPINDLE_ORIENTED: t.spindleOriented,
    SPINDLE_FOLLOWS_PATH: t.spindleFollowsPath,
    SPINDLE_SYNCHRONIZING: t.spindleSynchronizing,
    SPINDLE_SYNCHRONIZED: t.spindleSynchronized,
  };
  return (
    <span class="dim" data-test="spindle-state">
      {conditions[spindle.condition]} · {spindle.homed ? `${fixed(spindle.angle, 2)}°` : t.spindleNotHomed}
    </span>
  );
}

export function Technology() {
  const one = channel.value;
  if (!one) return null;
  const t = text.value;
  const spindle = machine.value.drive?.spindle_speed[0];
  const state = machine.value.drive?.spindles?.[0];
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
          {state && <SpindleState spindle={state} />}
        </div>
        <div>
          <b>T</b>
          <span class="value">{one.tool}</span>
          <span class="dim">
            H{one.length_offset} · {fixed(one.tool_length)} mm
          </span>
        </div>
      </div>
      <div class="modal" role="group" aria-label={t.activeCodes}>
        <span class="dim">{t.parts} {one.parts}</span>
        {one.modal.map((code) => (
          <span key={code}>{code}</span>
        ))}
      </div>
    </section>
  );
}
