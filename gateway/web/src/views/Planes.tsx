// SPDX-License-Identifier: Apache-2.0
// The tilted planes of G68.1: three points each, typed or taken from the present position.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { type Answer, get, put } from "../api";
import type { Parameter } from "../contract";
import { fixed, refusal } from "../format";
import type { Channel } from "../state/model";
import { isEmpty, planeAxes, planeCount, planeParameter, type PlanePoints, type Point } from "../state/planes";
import { channel, machine, tell } from "../state/store";
import { changedSince, remember } from "../state/undo";
import { hindrances } from "../state/work_zero";
import { text } from "../text/texts";
import { Cell } from "./Cell";
import { Guard } from "./Guard";

/** Stored values, which may still wait for a reset, by number. */
const values = signal<Map<number, { value: number; pending: boolean }>>(new Map());
const chosen = signal(1);

async function read(): Promise<Answer<{ parameters: Parameter[] }>> {
  return get("/api/parameters?class=channel&search=tilted_plane_points&limit=4000");
}

const storedIn = (list: Parameter[]) =>
  new Map(list.map((one) => [one.number, { value: Number(one.pending ? one.pending_value : one.value), pending: one.pending }]));

async function refresh(): Promise<void> {
  const answer = await read();
  if (answer.body) values.value = storedIn(answer.body.parameters);
}

function pointsOf(all: typeof values.value, first: number): PlanePoints {
  const at = (i: number) => all.get(first + i)?.value ?? 0;
  return [0, 3, 6].map((i) => [at(i), at(i + 1), at(i + 2)]) as PlanePoints;
}

/** Stores some of the nine numbers of a plane at once. */
async function store(first: number, from: number, numbers: number[], what: string): Promise<Answer> {
  const send = (list: number[]) => put("/api/parameters", { values: list.map((value, i) => ({ number: first + from + i, value })) });
  const before = numbers.map((_, i) => values.peek().get(first + from + i)?.value ?? 0);
  const answer = await send(numbers);
  if (!answer.ok) return answer;
  remember({
    what,
    undo: async () => {
      const now = await read();
      if (!now.body) return now;
      const known = storedIn(now.body.parameters);
      return numbers.every((value, i) => known.get(first + from + i)?.value === value) ? send(before) : changedSince();
    },
  });
  await refresh();
  return answer;
}

/** X Y Z of the tool tip in the workpiece; undefined for a channel without one of them. */
function tipOf(one: Channel): Point | undefined {
  const indices = [..."XYZ"].map((letter) => one.letters.indexOf(letter));
  return indices.some((index) => index < 0) ? undefined : (indices.map((index) => one.workpiece[index] ?? 0) as Point);
}

const direction = (v: Point) => v.map((value) => fixed(value, 4)).join("  ");

function PlaneForm({ one }: { one: Channel }) {
  const t = text.value;
  const plane = chosen.value;
  const first = planeParameter(one.channel, plane);
  const points = pointsOf(values.value, first);
  const axes = planeAxes(points);
  const turned = hindrances(one.modal);
  const moving = one.state !== "IDLE" && one.state !== "HELD";
  const tip = tipOf(one);
  const titles = [t.planeOrigin, t.planeOnX, t.planeOnY];
  const teach = (point: number) => {
    if (!tip) return;
    const what = `Q${plane} ${titles[point]}`;
    void store(first, 3 * point, tip, `${what} ${tip.map((value) => fixed(value)).join(" ")}`).then((answer) =>
      tell(answer.ok ? t.stored(what) : refusal(what, answer.reason), !answer.ok));
  };
  return (
    <section class="plane" aria-label={t.plane(plane)}>
      <div class="title"><h2>{t.plane(plane)}</h2><span class="dim">{t.planeAbout}</span></div>
      {turned.length > 0 && <p class="refusal" role="status">{t.notTurned(turned.join(" "))}</p>}
      {moving && <p class="refusal" role="status">{t.notMoving}</p>}
      <table>
        <thead><tr><td />{[..."XYZ"].map((letter) => <th class="right" key={letter}>{letter}</th>)}<td /></tr></thead>
        <tbody>
          {titles.map((title, point) => (
            <tr key={title}>
              <td>{title}</td>
              {[..."XYZ"].map((letter, i) => (
                <td class="right" key={letter}>
                  <Cell
                    value={points[point]![i]!}
                    label={`Q${plane} ${title} ${letter}`}
                    store={(value) => store(first, 3 * point + i, [value], `Q${plane} ${title} ${letter} ${fixed(points[point]![i]!)} → ${fixed(value)}`)}
                  />
                </td>
              ))}
              <td><button aria-label={t.teachPoint(title)} disabled={!tip || moving || turned.length > 0} onClick={() => teach(point)}>{t.teach}</button></td>
            </tr>
          ))}
        </tbody>
      </table>
      <dl>
        <dt>{t.planeX}</dt><dd class="digits">{axes ? direction(axes.x) : "–"}</dd>
        <dt>{t.planeZ}</dt><dd class="digits" data-test="plane-normal">{axes ? direction(axes.z) : "–"}</dd>
      </dl>
      {!isEmpty(points) && !axes && <p class="refusal" role="status">{t.planeOnLine}</p>}
      {Array.from({ length: 9 }, (_, i) => values.value.get(first + i)?.pending).some(Boolean) && <p class="tag warn">{t.waitsForReset}</p>}
      <div class="title">
        <button
          disabled={isEmpty(points)}
          onClick={() => void store(first, 0, Array.from({ length: 9 }, () => 0), t.planeCleared(plane)).then((answer) => !answer.ok && tell(answer.reason, true))}
        >
          {t.clearPlane(plane)}
        </button>
      </div>
    </section>
  );
}

export function Planes() {
  const { parameters, pending } = machine.value.revisions;
  useEffect(() => void refresh(), [parameters, pending]);
  const one = channel.value;
  if (!one) return null;
  const t = text.value;
  return (
    <>
      <section class="list plane-list" aria-label={t.planes}>
        <div class="title"><h2>{t.planes}</h2></div>
        <div class="scroll" tabIndex={0} role="region" aria-label={t.planes}>
          {Array.from({ length: planeCount }, (_, i) => i + 1).map((plane) => {
            const points = pointsOf(values.value, planeParameter(one.channel, plane));
            const axes = planeAxes(points);
            return (
              <button key={plane} class="choose" aria-pressed={plane === chosen.value} onClick={() => (chosen.value = plane)}>
                <b>G68.1 Q{plane}</b> <span class="dim digits">{isEmpty(points) ? t.planeEmpty : axes ? direction(axes.z) : t.planeInvalid}</span>
              </button>
            );
          })}
        </div>
      </section>
      <Guard needs="setter"><PlaneForm one={one} /></Guard>
    </>
  );
}
