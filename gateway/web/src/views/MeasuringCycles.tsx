// SPDX-License-Identifier: Apache-2.0
// Measuring a workpiece with the probe: a form for each cycle, the line that it makes for MDI, and its results.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get } from "../api";
import type { Variables } from "../contract";
import { fixed } from "../format";
import { isoHead } from "../program/dialects";
import { axesOf, type Cycle, cycles, type FieldName, lineOf, titled, type Typed, wrongFields } from "../state/measuring_cycles";
import { channel, command } from "../state/store";
import { text } from "../text/texts";
import { Guard } from "./Guard";

const chosen = signal<Cycle>(cycles[0]!);
const typed = signal<Typed>({ axis: "X" });
const variables = signal<Map<number, number>>(new Map());
/** The cycle whose results are shown; none before the first one of this page. */
const measured = signal<Cycle | null>(null);

async function readVariables(number: number): Promise<void> {
  const answer = await get<Variables>(`/api/variables/${number}`);
  if (answer.ok && answer.body) {
    const { numbers, values } = answer.body;
    variables.value = new Map(numbers.map((one, i) => [one, values[i] ?? 0]));
  }
}

async function execute(title: string, line: string, cycle: Cycle | null): Promise<void> {
  if (channel.peek()?.mode !== "MDI" && !(await command(title, "mode", { mode: "MDI" }))) return;
  if ((await command(title, "mdi", { line: `${isoHead}${line}` })) && cycle) measured.value = cycle;
}

const input = (field: FieldName, value: string) => (typed.value = { ...typed.peek(), [field]: value });

function Field({ name, cycle, wrong }: { name: FieldName; cycle: Cycle; wrong: boolean }) {
  const t = text.value;
  const value = typed.value[name] ?? "";
  const id = `measure-${name}`;
  const options = name === "axis" ? axesOf(cycle) : ["", "G54", "G55", "G56", "G57", "G58", "G59"];
  return (
    <>
      <label for={id}>{t[titled("measureField", name)]}</label>
      {name === "axis" || name === "offset" ? (
        <select id={id} value={options.includes(value) ? value : options[0]} onChange={(event) => input(name, event.currentTarget.value)}>
          {options.map((one) => <option key={one} value={one}>{one || t.measureNoOffset}</option>)}
        </select>
      ) : (
        <input id={id} class="digits" inputMode="decimal" autocomplete="off" aria-invalid={wrong && value !== ""} value={value}
          onInput={(event) => input(name, event.currentTarget.value)} />
      )}
    </>
  );
}

function Results() {
  const t = text.value;
  const cycle = measured.value;
  const rows = cycle?.results.filter(([number]) => variables.value.has(number)) ?? [];
  if (!cycle || rows.length === 0) return null;
  return (
    <table data-test="measured" aria-label={t.measureResults}>
      <caption>{t[titled("measureCycle", cycle.name)]}</caption>
      <tbody>
        {rows.map(([number, name]) => (
          <tr key={number}>
            <th scope="row">{t[titled("measureValue", name)]}</th>
            <td class="digits right">{fixed(variables.value.get(number)!, 4)} {name === "angle" ? "°" : "mm"}</td>
            <td class="dim digits">#{number}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function MeasuringCycles() {
  const t = text.value;
  const one = channel.value;
  const idle = one?.state === "IDLE";
  const number = one?.channel;
  useEffect(() => {
    if (idle && number !== undefined) void readVariables(number);
  }, [idle, number]);
  const cycle = chosen.value;
  const wrong = wrongFields(cycle, typed.value);
  const line = lineOf(cycle, typed.value);
  const calibrated = (variables.value.get(560) ?? 0) > 0;
  return (
    <section class="measuring" aria-label={t.measure}>
      <Guard needs="operator">
        <form
          onSubmit={(event) => {
            event.preventDefault();
            void execute(t[titled("measureCycle", cycle.name)], line, cycle);
          }}
        >
          <div class="segments" role="group" aria-label={t.measureCycle}>
            {cycles.map((candidate) => (
              <button key={candidate.name} type="button" aria-pressed={candidate === cycle} onClick={() => (chosen.value = candidate)}>
                {t[titled("measureCycle", candidate.name)]}
              </button>
            ))}
          </div>
          <p class="dim">{t[titled("measureAbout", cycle.name)]}</p>
          <div class="measuring-fields">
            {cycle.fields.map((name) => <Field key={name} name={name} cycle={cycle} wrong={wrong.includes(name)} />)}
          </div>
          <div class="row">
            <button type="button" disabled={!idle} onClick={() => void execute(t.probeOn, "M40", null)}>{t.probeOn}</button>
            <button type="button" disabled={!idle} onClick={() => void execute(t.probeOff, "M41", null)}>{t.probeOff}</button>
            <button type="submit" data-test="measure" disabled={!idle || wrong.length > 0}>{t.measureStart}</button>
            <code data-test="measure-line">{wrong.length > 0 ? "" : line}</code>
          </div>
          {!calibrated && cycle.name !== "calibrate" && <p class="note" role="status">{t.measureNotCalibrated}</p>}
        </form>
      </Guard>
      <Results />
    </section>
  );
}
