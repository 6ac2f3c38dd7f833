// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { fixed } from "../format";
import { axisRows } from "../state/model";
import { channel, machine } from "../state/store";
import { text } from "../text/texts";

/** Which coordinates are the large digits. */
const large = signal<"workpiece" | "machine">("workpiece");

function Load({ letter, load = 0 }: { letter: string; load?: number }) {
  const percent = Math.round(100 * load);
  return (
    <div
      class={`load ${load > 1 ? "bad" : load > 0.8 ? "warn" : ""}`}
      role="meter"
      aria-label={text.value.loadOf(letter)}
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuenow={Math.min(100, percent)}
      title={`${text.value.loadOf(letter)}: ${percent}`}
    >
      <i style={{ width: `${Math.min(100, percent)}%` }} />
    </div>
  );
}

export function Positions() {
  const one = channel.value;
  if (!one) return null;
  const t = text.value;
  const rows = axisRows(machine.value, one);
  const workpieceLarge = large.value === "workpiece";
  return (
    <section class="positions" aria-label={t.positions}>
      <div class="title">
        <div class="segments" role="group" aria-label={t.positions}>
          <button aria-pressed={workpieceLarge} onClick={() => (large.value = "workpiece")}>
            {t.workpiece} G{54 + one.work_offset}
          </button>
          <button aria-pressed={!workpieceLarge} onClick={() => (large.value = "machine")}>
            {t.machine}
          </button>
        </div>
        {!one.homed && <span class="tag warn">{t.notReferenced}</span>}
        {one.rtcp && <span class="tag note">RTCP</span>}
      </div>
      <div class={`rows ${rows.length > 5 ? "many" : ""}`} tabIndex={0} role="region" aria-label={t.positions}>
        {rows.map((row) => (
          <div
            class={`axis ${row.enabled === false ? "off" : ""} ${row.homed ? "" : "unreferenced"}`}
            key={row.index}
            data-axis={row.letter}
          >
            <span class="letter" title={row.homed ? undefined : t.notReferenced}>{row.letter}</span>
            <span class="large digits" data-test={`position-${row.letter}`}>
              {fixed(workpieceLarge ? row.workpiece : row.machine)}
            </span>
            <dl class="digits">
              <dt class="go">{t.toGo}</dt>
              <dd class="go" data-test={`to-go-${row.letter}`}>{fixed(row.distanceToGo)}</dd>
              <dt>{workpieceLarge ? t.machineShort : t.workpieceShort}</dt>
              <dd>{fixed(workpieceLarge ? row.machine : row.workpiece)}</dd>
              <dt title={t.followingError}>{t.followingErrorShort}</dt>
              <dd>{row.followingError === undefined ? "–" : fixed(row.followingError, 4)}</dd>
            </dl>
            <Load letter={row.letter} load={row.load} />
          </div>
        ))}
      </div>
    </section>
  );
}
