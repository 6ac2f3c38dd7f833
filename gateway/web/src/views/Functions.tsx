// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { allLocks, levelsWith, locksWith, offsets, skipLevels, skips } from "../state/functions";
import { axisRows } from "../state/model";
import { channel, command, machine } from "../state/store";

const increments = [0.001, 0.01, 0.1, 1];
const line = signal("");
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
  const search = () => {
    const wanted = Number(line.value);
    if (line.value.trim() !== "") void command("Start from line", "start-from-line", { line: wanted });
  };
  return (
    <form
      class="row"
      onSubmit={(event) => {
        event.preventDefault();
        search();
      }}
    >
      <label for="from-line">Line</label>
      <input
        id="from-line"
        data-test="from-line"
        class="digits"
        inputMode="numeric"
        placeholder="number"
        value={line.value}
        onInput={(event) => (line.value = event.currentTarget.value)}
      />
      <button type="submit" data-test="search-line" title="Search the line; cycle start then approaches it">
        Search line
      </button>
      {offered > 0 && <span class="dim">left in line {offered}</span>}
    </form>
  );
}

function Handwheel() {
  const one = channel.value!;
  const turn = (counts: number) =>
    void command("Handwheel", "handwheel", { axis: wheelAxis.value, counts, increment: wheelIncrement.value });
  return (
    <div class="row">
      <div class="segments small" role="group" aria-label="handwheel axis">
        {axisRows(machine.value, one).map((row) => (
          <button key={row.index} aria-pressed={wheelAxis.value === row.index} onClick={() => (wheelAxis.value = row.index)}>
            {row.letter}
          </button>
        ))}
      </div>
      <select
        aria-label="increment of a count"
        value={String(wheelIncrement.value)}
        onChange={(event) => (wheelIncrement.value = Number(event.currentTarget.value))}
      >
        {increments.map((value) => (
          <option key={value} value={String(value)}>
            {value}
          </option>
        ))}
      </select>
      <button data-test="wheel-" aria-label="handwheel one count back" onClick={() => turn(-1)}>
        −
      </button>
      <div
        class="wheel"
        title="Turn the mouse wheel here"
        data-test="wheel"
        onWheel={(event) => {
          event.preventDefault();
          turn(event.deltaY < 0 ? 1 : -1);
        }}
      >
        ◎
      </div>
      <button data-test="wheel+" aria-label="handwheel one count on" onClick={() => turn(1)}>
        +
      </button>
    </div>
  );
}

export function Functions() {
  const one = channel.value;
  if (!one) return null;
  const offset = offsets(one);
  return (
    <div class="functions">
      <h3>Start from a line</h3>
      <FromLine offered={one.restart_line} />
      <h3>Program</h3>
      <div class="row">
        <Switch title="Dry run" about="Feed of parameter 04c914 in place of the program's" route="dry-run" on={one.dry_run} />
        <Switch title="M S T lock" about="Functions are skipped" route="auxiliary-lock" on={one.auxiliary_lock} />
        <Switch title="Retrace" about="Backwards along the path; again: forwards" route="retrace" on={one.retracing} />
      </div>
      <div class="row">
        <span class="name">Axis lock</span>
        <div class="segments small" role="group" aria-label="axis lock">
          <button data-test="lock-all" onClick={() => void command("Axis lock", "axis-lock", { axes: allLocks(one) })}>
            all
          </button>
          {[...one.letters].map((letter, i) => (
            <button
              key={letter}
              aria-pressed={one.locked[i] === 1}
              data-test={`lock-${letter}`}
              onClick={() => void command("Axis lock", "axis-lock", { axes: locksWith(one, i) })}
            >
              {letter}
            </button>
          ))}
        </div>
      </div>
      <div class="row">
        <span class="name">Skip /</span>
        <div class="segments small" role="group" aria-label="block skip levels">
          {skipLevels.map((level) => (
            <button
              key={level}
              aria-pressed={skips(one, level)}
              data-test={`skip-${level}`}
              onClick={() => void command("Block skip", "block-skip", { levels: levelsWith(one, level) })}
            >
              {level}
            </button>
          ))}
        </div>
      </div>
      <h3>Handwheel</h3>
      <Handwheel />
      <div class="row">
        <Switch
          title="Offset on the program"
          about="Counts are added to the path, until reset"
          route="handwheel-offset"
          on={one.handwheel_offset_on}
        />
        <span class="digits">{offset.join("  ")}</span>
      </div>
    </div>
  );
}
