// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { get } from "../api";
import type { Parameter } from "../contract";
import { homingBy, homingLine, type HomingWay, readHomingWay } from "../state/homing";
import { JogHold } from "../state/jog";
import { type AxisRow, axisRows, type Channel, inhibition } from "../state/model";
import { channel, channelNumber, commandTo, machine, renewJog, stop } from "../state/store";
import { text } from "../text/texts";

const increments = [0, 0.001, 0.01, 0.1, 1, 10];
const speeds = [60, 200, 600, 2000, 6000];

const increment = signal(0);
const speed = signal(600);
/** Jog speed of each axis at 100 %, parameter 10x032, by logical axis number. */
const limits = signal<Record<number, number>>({});
/** How the channel shown homes all its axes; null while that is not known. */
const homing = signal<HomingWay | null>(null);

async function loadLimits(axes: number[]): Promise<void> {
  const found: Record<number, number> = {};
  for (const axis of axes) {
    const answer = await get<Parameter>(`/api/parameters/${100032 + 1000 * axis}`);
    if (answer.ok && answer.body) found[axis] = Number(answer.body.value);
  }
  limits.value = found;
}

/** One line of MDI: the channel carries it out to its end, also when this page is gone. */
async function homeAll(number: number, way: HomingWay, letters: string): Promise<void> {
  const what = text.peek().homeAllBy(homingBy(way, letters));
  if (!(await commandTo(number, what, "mode", { mode: "MDI" }))) return;
  await commandTo(number, what, "mdi", { line: homingLine(way, letters) });
}

/** Dark while the channel does something: the change of the mode would end the search of an axis. */
function HomeAll({ channel: one }: { channel: Channel }) {
  const t = text.value;
  const inhibited = inhibition(machine.value, one, "start", t.inhibitedByPlc);
  const way = homing.value;
  const by = way ? homingBy(way, one.letters) : "";
  return (
    <button
      class="home-all"
      data-test="home-all"
      aria-label={by ? t.homeAllBy(by) : t.homeAll}
      title={inhibited || by}
      disabled={inhibited !== "" || way === null || one.state !== "IDLE"}
      onClick={() => way && void homeAll(one.channel, way, one.letters)}
    >
      ⌂ {t.homeAll}
      <small>{by}</small>
    </button>
  );
}

export function Jog() {
  const number = channelNumber.value;
  const hold = useMemo(() => {
    const none = Promise.resolve(false);
    return new JogHold({
      start: (jog, press) => (number === null ? none : commandTo(number, text.peek().jog, "jog", { ...jog, press })),
      renew: (press) => (number === null ? none : renewJog(number, press)),
      stop: (axis) => (number === null ? none : stop(text.peek().jogStop, `/api/channels/${number}/jog-stop`, { axis })),
    });
  }, [number]);
  useEffect(() => {
    // Whatever takes the operator's finger, window or page away ends the movement.
    const release = () => hold.release();
    const hidden = () => document.hidden && hold.release();
    window.addEventListener("blur", release);
    window.addEventListener("pagehide", release);
    document.addEventListener("visibilitychange", hidden);
    return () => {
      hold.release();
      window.removeEventListener("blur", release);
      window.removeEventListener("pagehide", release);
      document.removeEventListener("visibilitychange", hidden);
    };
  }, [hold]);
  const one = channel.value;
  const revision = machine.value.revisions.parameters;
  const axes = one?.axes.join();
  useEffect(() => void loadLimits(channel.peek()?.axes ?? []), [revision, axes]);
  const reference = one?.mode === "REF";
  const stored = machine.value.revisions.programs;
  useEffect(() => {
    let newest = true;
    homing.value = null;
    if (number !== null && reference) void readHomingWay(number).then((way) => newest && (homing.value = way));
    return () => {
      newest = false;
    };
  }, [number, reference, revision, stored]);
  if (!one) return null;
  const t = text.value;
  const inhibited = inhibition(machine.value, one, "manual", t.inhibitedByPlc);
  const usable = (one.mode === "JOG" || reference) && !inhibited;

  const direction = ({ index: axis, number, letter, unit }: AxisRow, sign: 1 | -1) => {
    const used = Math.min(speed.value, limits.value[number] ?? speed.value);
    const press = () => hold.press({ axis, speed: sign * used, increment: increment.value });
    return (
      <button
        class="direction"
        disabled={!usable}
        title={inhibited || `${used} ${unit}/min`}
        aria-label={sign > 0 ? t.jogPlus(letter) : t.jogMinus(letter)}
        data-test={`jog-${letter}${sign > 0 ? "+" : "-"}`}
        onPointerDown={(event) => {
          if (event.button !== 0) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          press();
        }}
        onPointerUp={() => hold.release()}
        onPointerCancel={() => hold.release()}
        onLostPointerCapture={() => hold.release()}
        onBlur={() => hold.release()}
        onContextMenu={(event) => event.preventDefault()}
        onKeyDown={(event) => {
          if (event.key !== " " && event.key !== "Enter") return;
          event.preventDefault();
          if (!event.repeat && !event.ctrlKey) press();
        }}
        onKeyUp={() => hold.release()}
      >
        {sign > 0 ? "+" : "−"}
      </button>
    );
  };

  return (
    <section class={`jog ${usable ? "" : "idle"}`} aria-label={t.jog}>
      {inhibited && <p class="dim" role="status" data-test="jog-inhibited">{inhibited}</p>}
      <div class="pad">
        {axisRows(machine.value, one).map((row) => (
          <div class="jog-axis" key={row.index}>
            {direction(row, 1)}
            {reference ? (
              <button
                class={`home ${row.homed ? "" : "unreferenced"}`}
                data-test={`reference-${row.letter}`}
                aria-label={`${t.referenceAxis(row.letter)}: ${row.homed ? t.referenced : t.notReferenced}`}
                title={inhibited}
                disabled={!usable}
                onClick={() => void commandTo(one.channel, t.modeReference, "reference", { axis: row.index })}
              >
                ⌂ {row.letter}
                <small>{row.homed ? "✓" : "?"}</small>
              </button>
            ) : (
              <b>{row.letter}</b>
            )}
            {direction(row, -1)}
          </div>
        ))}
      </div>
      <div class="jog-choice">
        {reference ? (
          <HomeAll channel={one} />
        ) : (
          <>
            <label>
              <span>{t.step}</span>
              <select
                aria-label={t.stepUnit}
                title={usable ? t.stepUnit : t.chooseJog}
                value={String(increment.value)}
                onChange={(event) => (increment.value = Number(event.currentTarget.value))}
              >
                {increments.map((value) => (
                  <option key={value} value={String(value)}>
                    {value === 0 ? t.whileHeld : value}
                  </option>
                ))}
              </select>
            </label>
            <label>
              <span>{t.speed}</span>
              <select aria-label={t.speedUnit} title={t.speedUnit} value={String(speed.value)} onChange={(event) => (speed.value = Number(event.currentTarget.value))}>
                {speeds.map((value) => (
                  <option key={value} value={String(value)}>
                    {value}
                  </option>
                ))}
              </select>
            </label>
          </>
        )}
      </div>
    </section>
  );
}
