// SPDX-License-Identifier: Apache-2.0
// Work offsets of the chosen channel: the table, and what sets one from the present position.
import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { type Answer, get, put } from "../api";
import type { WorkOffset, WorkOffsets as Table } from "../contract";
import { fixed, refusal, typedNumber } from "../format";
import type { Channel } from "../state/model";
import { channel, channels, machine, tell } from "../state/store";
import { changedSince, remember } from "../state/undo";
import { axisLetters, externalOffset, hindrances, isTakenOver, type OffsetChange, offsetChange, offsetFor, offsetIndices, offsetName } from "../state/work_zero";
import { text } from "../text/texts";
import { Cell } from "./Cell";
import { Guard } from "./Guard";

const table = signal<Table>({ set: 0, revision: 0, offsets: [] });
const chosen = signal(0);
/** By channel: the newest change of its active offset. */
const underWay = signal<Record<number, OffsetChange>>({});

const read = () => get<Table>("/api/work-offsets");

async function refresh(): Promise<void> {
  const answer = await read();
  if (answer.body?.offsets) table.value = answer.body;
}

function rowOf(all: Table, channelNumber: number, index: number): WorkOffset {
  const found = all.offsets.find((offset) => offset.channel === channelNumber && offset.index === index);
  return found ?? { channel: channelNumber, index, values: [...axisLetters].map(() => 0) };
}

const equal = (a: readonly number[], b: readonly number[]) => a.length === b.length && a.every((value, i) => value === b[i]);

/** Stores the whole row, made on the table that is shown; the change can be taken back. */
async function store(row: WorkOffset, values: number[]): Promise<Answer> {
  const { channel: number, index } = row;
  const send = async (from: number[], to: number[], revision: number) => {
    const one = channels.peek()[String(number)];
    const acts = index === one?.work_offset || index === externalOffset;
    const change = one && acts ? offsetChange(one, from, to, underWay.peek()[number]) : undefined;
    const answer = await put("/api/work-offsets", { channel: number, index, values: to, revision });
    if (answer.ok && change) underWay.value = { ...underWay.peek(), [number]: change };
    return answer;
  };
  const answer = await send(row.values, values, table.peek().revision);
  if (!answer.ok) return answer;
  const different = [...axisLetters].flatMap((letter, i) =>
    row.values[i] === values[i] ? [] : [`${letter} ${fixed(row.values[i] ?? 0)} → ${fixed(values[i]!)}`]);
  remember({
    what: `${offsetName(index)} ${different.join(", ")}`,
    undo: async () => {
      const now = await read();
      if (!now.body) return now;
      return equal(rowOf(now.body, number, index).values, values) ? send(values, [...row.values], now.body.revision) : changedSince();
    },
  });
  await refresh();
  return answer;
}

/** Columns of the channel's axes. */
const columnsOf = (one: Channel) => [...axisLetters].map((letter, column) => ({ letter, column })).filter(({ letter }) => one.letters.includes(letter));

/** Those of the table: a setting error has three angles, of whatever axes the channel has to turn. */
function tableColumns(one: Channel) {
  const turns = [..."ABC"].some((letter) => one.letters.includes(letter));
  return [...axisLetters].map((letter, column) => ({ letter, column })).filter(({ letter }) => one.letters.includes(letter) || (turns && "ABC".includes(letter)));
}

/** Whether a row of the table has a value for the letter. */
const hasCell = (one: Channel, index: number, letter: string) =>
  index > externalOffset ? "XYZABC".includes(letter) : one.letters.includes(letter);

function FromPosition({ one }: { one: Channel }) {
  const wanted = useSignal<Record<string, string>>({});
  const deltas = useSignal<Record<string, string>>({});
  const busy = useSignal(false);
  const t = text.value;
  const row = rowOf(table.value, one.channel, chosen.value);
  const name = offsetName(row.index);
  const turned = hindrances(one.modal);
  const moving = one.state !== "IDLE" && one.state !== "HELD";
  // The position that the key uses must be that with the offset as it is now.
  const change = underWay.value[one.channel];
  // A position does not say how a workpiece stands.
  const zero = row.index <= externalOffset;
  const usable = zero && turned.length === 0 && !moving && !busy.value && (!change || isTakenOver(change, one));
  const save = async (values: number[], what: string) => {
    busy.value = true;
    const answer = await store(row, values);
    tell(answer.ok ? t.stored(what) : refusal(what, answer.reason), !answer.ok);
    busy.value = false;
  };
  const shown = (letter: string) => channel.value?.workpiece[one.letters.indexOf(letter)] ?? 0;
  const set = (letter: string, column: number) => {
    const entered = typedNumber(wanted.value[letter] || "0");
    if (entered === undefined) return tell(`${letter}: ${t.notANumber}`, true);
    const acting = chosen.peek() === externalOffset ? externalOffset : one.work_offset;
    const active = rowOf(table.peek(), one.channel, acting).values[column] ?? 0;
    void save(row.values.map((value, i) => (i === column ? offsetFor(active, shown(letter), entered) : value)), `${name} ${letter}`);
  };
  const add = () => {
    const entered = columnsOf(one).map(({ letter, column }) => ({ letter, column, delta: typedNumber(deltas.value[letter] || "0") }));
    const wrong = entered.find(({ delta }) => delta === undefined);
    if (wrong) return tell(`${wrong.letter}: ${t.notANumber}`, true);
    const values = [...row.values];
    for (const { column, delta } of entered) values[column] = Math.round(((values[column] ?? 0) + delta!) * 1e9) / 1e9;
    if (equal(values, row.values)) return;
    void save(values, name).then(() => (deltas.value = {}));
  };
  return (
    <section class="side-form" aria-label={t.setOffset(name)}>
      <div class="title"><h2>{t.setOffset(name)}</h2></div>
      {turned.length > 0 && <p class="refusal" role="status">{t.notTurned(turned.join(" "))}</p>}
      {moving && <p class="refusal" role="status">{t.notMoving}</p>}
      <div class="scroll" tabIndex={0} role="region" aria-label={t.setOffset(name)}>
        <table>
          <thead>
            <tr><th>{t.axis}</th><th class="right">{t.shows}</th><th>{t.shallShow}</th><td /><th>{t.delta}</th></tr>
          </thead>
          <tbody>
            {columnsOf(one).map(({ letter, column }) => (
              <tr key={letter}>
                <td><b>{letter}</b></td>
                <td class="right digits">{fixed(shown(letter))}</td>
                <td>
                  <input
                    class="short digits" inputMode="decimal" placeholder="0" aria-label={t.shallShowOf(letter)} value={wanted.value[letter] ?? ""}
                    onInput={(event) => (wanted.value = { ...wanted.value, [letter]: event.currentTarget.value })}
                  />
                </td>
                <td><button disabled={!usable} aria-label={t.setAxis(name, letter)} onClick={() => set(letter, column)}>{t.set}</button></td>
                <td>
                  <input
                    class="short digits" inputMode="decimal" placeholder="0" aria-label={t.deltaOf(letter)} value={deltas.value[letter] ?? ""}
                    onInput={(event) => (deltas.value = { ...deltas.value, [letter]: event.currentTarget.value })}
                  />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <button class="primary" disabled={busy.value} onClick={add}>{t.addDeltas(name)}</button>
    </section>
  );
}

export function WorkOffsets() {
  const revision = machine.value.revisions.work_offsets;
  useEffect(() => void refresh(), [revision]);
  const one = channel.value;
  if (!one) return null;
  const t = text.value;
  const columns = tableColumns(one);
  return (
    <>
      <section class="list" aria-label={t.workOffsets}>
        <div class="title">
          <h2>{t.workOffsets}</h2>
          <span class="dim">{t.workOffsetsAbout}</span>
        </div>
        <div class="scroll">
          <table>
            <thead>
              <tr><td /> {columns.map(({ letter }) => <th class="right" key={letter}>{letter}</th>)}</tr>
            </thead>
            <tbody>
              {offsetIndices.map((index) => rowOf(table.value, one.channel, index)).map((row) => (
                <tr key={row.index} class={row.index === one.work_offset ? "chosen" : ""}>
                  <td>
                    <button aria-pressed={row.index === chosen.value} onClick={() => (chosen.value = row.index)}>{offsetName(row.index)}</button>
                    {row.index === one.work_offset && <span class="dim"> {t.activeOffset}</span>}
                  </td>
                  {columns.map(({ letter, column }) => (
                    <td key={letter} class="right">
                      {hasCell(one, row.index, letter) && (
                        <Cell
                          value={row.values[column] ?? 0}
                          label={`${offsetName(row.index)} ${letter}`}
                          store={(value) => store(row, row.values.map((old, i) => (i === column ? value : old)))}
                        />
                      )}
                    </td>
                  ))}
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      </section>
      <Guard needs="setter"><FromPosition one={one} /></Guard>
    </>
  );
}
