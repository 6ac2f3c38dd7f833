// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { allLocks, levelsWith, locksWith, offsets, skipLevels, skips } from "../state/functions";
import { axisRows } from "../state/model";
import { channel, command, machine } from "../state/store";
import { text } from "../text/texts";
import { Guard } from "./Guard";

const increments = [0.001, 0.01, 0.1, 1];
const line = signal("");
const parts = signal("");
const spindleTool = signal("");
const wheelAxis = signal(0);
const wheelIncrement = signal(0.01);

type SwitchRoute = "dry-run" | "auxiliary-lock" | "retrace" | "handwheel-offset";

function Switch({ title, about, route, on }: { title: string; about: string; route: SwitchRoute; on: boolean }) {
  return (
    <button
      class="toggle"
      aria-pressed={on}
      title={about}
      data-test={route}
      onClick={() => void command(title, route, { on: !on })}
    >
      {title}
    </button>
  );
}

/** The start from a line; the line in which the control was switched off is offered. */
function FromLine({ offered }: { offered: number }) {
  useEffect(() => {
    if (offered > 0) line.value = String(offered);
  }, [offered]);
  const t = text.value;
  const search = () => {
    const wanted = Number(line.value);
    if (line.value.trim() !== "") void command(t.startFromLine, "start-from-line", { line: wanted });
  };
  return (
    <form
      class="row"
      onSubmit={(event) => {
        event.preventDefault();
        search();
      }}
    >
      <label for="from-line">{t.line}</label>
      <input
        id="from-line"
        data-test="from-line"
        class="digits"
        inputMode="numeric"
        placeholder={t.lineNumber}
        value={line.value}
        onInput={(event) => (line.value = event.currentTarget.value)}
      />
      <button type="submit" data-test="search-line" title={t.searchLineAbout}>
        {t.searchLine}
      </button>
      {offered > 0 && <span class="dim">{t.offeredLine(offered)}</span>}
    </form>
  );
}

/** Parts that were machined; the operator sets the count, to 0 for a new order. */
function Parts({ count }: { count: number }) {
  const t = text.value;
  const set = (parts: number) => void command(t.setParts, "parts", { parts });
  return (
    <form
      class="row"
      aria-label={t.parts}
      onSubmit={(event) => {
        event.preventDefault();
        if (parts.value.trim() === "") return;
        set(Number(parts.value));
        parts.value = "";
      }}
    >
      <b class="digits" data-test="parts">{count}</b>
      <input
        class="short digits"
        data-test="parts-wanted"
        inputMode="numeric"
        aria-label={t.setParts}
        placeholder={t.lineNumber}
        value={parts.value}
        onInput={(event) => (parts.value = event.currentTarget.value)}
      />
      <button type="submit" data-test="set-parts">{t.setKey}</button>
      <button type="button" data-test="zero-parts" onClick={() => set(0)}>{t.zeroParts}</button>
    </form>
  );
}

/** After a change by hand; M6 states it by itself. */
function Spindle({ tool }: { tool: number }) {
  const t = text.value;
  return (
    <form
      class="row"
      aria-label={t.toolInSpindle}
      onSubmit={(event) => {
        event.preventDefault();
        if (spindleTool.value.trim() === "") return;
        void command(t.stateTool, "tool-in-spindle", { tool: Number(spindleTool.value) });
        spindleTool.value = "";
      }}
    >
      <b class="digits" data-test="spindle-tool">T{tool}</b>
      <input
        class="short digits"
        data-test="spindle-tool-wanted"
        inputMode="numeric"
        aria-label={t.stateTool}
        placeholder={t.lineNumber}
        value={spindleTool.value}
        onInput={(event) => (spindleTool.value = event.currentTarget.value)}
      />
      <button type="submit" data-test="set-spindle-tool" title={t.stateTool}>{t.stateKey}</button>
    </form>
  );
}

function Handwheel() {
  const one = channel.value!;
  const t = text.value;
  const turn = (counts: number) =>
    void command(t.handwheel, "handwheel", { axis: wheelAxis.value, counts, increment: wheelIncrement.value });
  return (
    <div class="row">
      <div class="segments small" role="group" aria-label={t.handwheelAxis}>
        {axisRows(machine.value, one).map((row) => (
          <button key={row.index} aria-label={t.handwheelOf(row.letter)} aria-pressed={wheelAxis.value === row.index} onClick={() => (wheelAxis.value = row.index)}>
            {row.letter}
          </button>
        ))}
      </div>
      <select
        aria-label={t.incrementOfCount}
        value={String(wheelIncrement.value)}
        onChange={(event) => (wheelIncrement.value = Number(event.currentTarget.value))}
      >
        {increments.map((value) => (
          <option key={value} value={String(value)}>
            {value}
          </option>
        ))}
      </select>
      <button data-test="wheel-" aria-label={t.countBack} onClick={() => turn(-1)}>
        −
      </button>
      <div
        class="wheel"
        title={t.turnHere}
        data-test="wheel"
        onWheel={(event) => {
          event.preventDefault();
          turn(event.deltaY < 0 ? 1 : -1);
        }}
      >
        ◎
      </div>
      <button data-test="wheel+" aria-label={t.countOn} onClick={() => turn(1)}>
        +
      </button>
    </div>
  );
}

export function Functions() {
  const one = channel.value;
  if (!one) return null;
  const offset = offsets(one);
  const t = text.value;
  return (
    <div class="functions">
      <Guard needs="operator">
        <h3>{t.startFromLine}</h3>
        <FromLine offered={one.restart_line} />
        <h3>{t.program}</h3>
        <div class="row">
          <Switch title={t.dryRun} about={t.dryRunAbout} route="dry-run" on={one.dry_run} />
          <Switch title={t.auxiliaryLock} about={t.auxiliaryLockAbout} route="auxiliary-lock" on={one.auxiliary_lock} />
          <Switch title={t.retrace} about={t.retraceAbout} route="retrace" on={one.retracing} />
        </div>
        <div class="row">
          <span class="name">{t.axisLock}</span>
          <div class="segments small" role="group" aria-label={t.axisLock}>
            <button data-test="lock-all" aria-label={t.lockAllAxes} onClick={() => void command(t.axisLock, "axis-lock", { axes: allLocks(one) })}>
              {t.lockAll}
            </button>
            {[...one.letters].map((letter, i) => (
              <button
                key={letter}
                aria-pressed={one.locked[i] === 1}
                data-test={`lock-${letter}`}
                aria-label={t.lockAxis(letter)}
                onClick={() => void command(t.axisLock, "axis-lock", { axes: locksWith(one, i) })}
              >
                {letter}
              </button>
            ))}
          </div>
        </div>
        <div class="row">
          <span class="name">{t.blockSkip}</span>
          <div class="segments small" role="group" aria-label={t.blockSkipLevels}>
            {skipLevels.map((level) => (
              <button
                key={level}
                aria-pressed={skips(one, level)}
                data-test={`skip-${level}`}
                aria-label={t.skipLevel(level)}
                onClick={() => void command(t.blockSkip, "block-skip", { levels: levelsWith(one, level) })}
              >
                {level}
              </button>
            ))}
          </div>
        </div>
        <h3>{t.parts}</h3>
        <Parts count={one.parts} />
        <h3>{t.toolInSpindle}</h3>
        <Spindle tool={one.tool} />
        <h3>{t.handwheel}</h3>
        <Handwheel />
        <div class="row">
          <Switch
            title={t.handwheelOffset}
            about={t.handwheelOffsetAbout}
            route="handwheel-offset"
            on={one.handwheel_offset_on}
          />
          <span class="digits">{offset.join("  ")}</span>
        </div>
      </Guard>
    </div>
  );
}
