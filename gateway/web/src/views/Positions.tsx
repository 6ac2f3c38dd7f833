// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { millimetres } from "../format";
import { axisRows } from "../state/model";
import { channel, machine } from "../state/store";

/** Which coordinates are the large digits. */
const large = signal<"workpiece" | "machine">("workpiece");

export function Positions() {
  const one = channel.value;
  if (!one) return null;
  const rows = axisRows(machine.value, one);
  const workpieceLarge = large.value === "workpiece";
  return (
    <section class="positions" aria-label="positions">
      <div class="title">
        <h2>Position</h2>
        {!one.homed && <span class="tag warn">not referenced</span>}
        {one.rtcp && <span class="tag note">RTCP</span>}
        <div class="segments small">
          <button aria-pressed={workpieceLarge} onClick={() => (large.value = "workpiece")}>
            Workpiece G{54 + one.work_offset}
          </button>
          <button aria-pressed={!workpieceLarge} onClick={() => (large.value = "machine")}>
            Machine
          </button>
        </div>
      </div>
      <div class={`rows ${rows.length > 6 ? "many" : ""}`}>
        {rows.map((row) => (
          <div class={`axis ${row.enabled === false ? "off" : ""}`} key={row.index} data-axis={row.letter}>
            <span class="letter">{row.letter}</span>
            <span class="large digits" data-test={`position-${row.letter}`}>
              {millimetres(workpieceLarge ? row.workpiece : row.machine)}
            </span>
            <dl class="digits">
              <dt>{workpieceLarge ? "Mach" : "Work"}</dt>
              <dd>{millimetres(workpieceLarge ? row.machine : row.workpiece)}</dd>
              <dt>To go</dt>
              <dd>{millimetres(row.distanceToGo)}</dd>
              <dt title="following error">Lag</dt>
              <dd>{row.followingError === undefined ? "–" : millimetres(row.followingError, 4)}</dd>
            </dl>
          </div>
        ))}
      </div>
    </section>
  );
}
