// SPDX-License-Identifier: Apache-2.0
// The calibration with dial and edge finder: checks before, steps with their readings, the check at nine poses.
import { effect, signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get, post } from "../api";
import type { ManualEvaluation, ManualGuide, ManualReading } from "../contract";
import { fixed, refusal, title as words } from "../format";
import { displacementsBody, emptyNotes, type Notes, notesFrom, offsetRows, readingsBody, seriesOf, wrongAlpha, wrongDisplacement, wrongReadings } from "../measurement/manual";
import { micrometres } from "../measurement/result";
import { sixDigits } from "../state/parameter_file";
import { keep, kept, language } from "../state/preferences";
import { channel, machine, tell } from "../state/store";
import { text } from "../text/texts";
import { Guard, GuardNote, lacking } from "./Guard";
import { ask } from "./Question";

const guide = signal<{ guide?: ManualGuide; reason: string }>({ reason: "" });
const notes = signal<Notes>(emptyNotes(""));
type Source = "readings" | "displacements";
/** What the gateway has computed, from what, and for which typed values. */
const result = signal<{ from: Source; body: string; evaluation: ManualEvaluation } | null>(null);

effect(() => {
  if (notes.value.kind !== "") keep("manual", JSON.stringify(notes.value));
});
const note = (change: Partial<Notes>) => (notes.value = { ...notes.peek(), ...change });

async function readGuide(number: number, alpha: string): Promise<void> {
  const angle = wrongAlpha(alpha) ? "30" : alpha.trim();
  const answer = await get<ManualGuide>(`/api/measurement/manual?channel=${number}&language=${language.peek()}&alpha=${angle}`);
  guide.value = answer.ok && answer.body ? { guide: answer.body, reason: "" } : { reason: answer.reason };
  const kind = answer.body?.kind;
  if (answer.ok && kind && notes.peek().kind !== kind) notes.value = notesFrom(kept("manual"), kind);
}

const bodyOf = (from: Source, number: number): object =>
  from === "readings" ? readingsBody(number, notes.value.readings) : displacementsBody(number, notes.value);

async function evaluate(from: Source, number: number): Promise<void> {
  const body = bodyOf(from, number);
  const answer = await post<ManualEvaluation>("/api/measurement/manual", body);
  if (answer.ok && answer.body) result.value = { from, body: JSON.stringify(body), evaluation: answer.body };
  else tell(refusal(text.peek().manualCompute, answer.reason), true);
}

async function write(from: Source, number: number): Promise<void> {
  const t = text.peek();
  const answer = await post<ManualEvaluation>("/api/measurement/manual/write", bodyOf(from, number));
  tell(answer.ok ? t.manualWritten(answer.body?.changes.length ?? 0) : refusal(t.measurementConfirm, answer.reason), !answer.ok);
  if (!answer.ok) return;
  result.value = null;
  // They were read with the vectors of before: used again they would correct twice.
  if (from === "displacements") note({ displacements: emptyNotes("").displacements });
}

function Field({ reading, wrong }: { reading: ManualReading; wrong: boolean }) {
  const value = notes.value.readings[reading.name] ?? "";
  return (
    <label>
      <span>{reading.about}</span>
      <input class="digits" inputMode="decimal" autocomplete="off" data-test={`manual-${reading.name}`} aria-invalid={wrong && value !== ""} value={value}
        onInput={(event) => note({ readings: { ...notes.peek().readings, [reading.name]: event.currentTarget.value } })} />
      <span class="dim">{reading.name === "alpha" ? "°" : "mm"}</span>
    </label>
  );
}

function Checks({ checks }: { checks: string[] }) {
  const { checked } = notes.value;
  return (
    <ol class="manual-checks">
      {checks.map((check, i) => (
        <li key={i}>
          <label>
            <input type="checkbox" checked={checked.includes(i)}
              onChange={(event) => note({ checked: event.currentTarget.checked ? [...checked, i] : checked.filter((one) => one !== i) })} />
            <span>{check}</span>
          </label>
        </li>
      ))}
    </ol>
  );
}

function Acceptance({ evaluation }: { evaluation: ManualEvaluation }) {
  const t = text.value;
  return (
    <table aria-label={t.manualAcceptance} data-test="manual-acceptance">
      <thead><tr><th>{t.manualAcceptance}</th><th class="right">um</th><th class="right">{t.manualLimit}</th><th /></tr></thead>
      <tbody>
        {evaluation.acceptance!.map(({ name, value_mm, limit_mm }) => {
          const series = seriesOf(name);
          return (
            <tr key={name}>
              <th scope="row">{series ? t.manualOver(series.component, series.axis) : name}</th>
              <td class="right digits">{micrometres(value_mm).replace("+", "")}</td>
              <td class="right digits">{micrometres(limit_mm).replace("+", "")}</td>
              <td>{value_mm <= limit_mm ? t.manualWithin : <b class="refusal">{t.manualExceeded}</b>}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function Result({ from, number }: { from: Source; number: number }) {
  const t = text.value;
  const shown = result.value;
  if (!shown || shown.from !== from || shown.body !== JSON.stringify(bodyOf(from, number))) return null;
  const { evaluation } = shown;
  // Another station has written since: these vectors begin from others than the active ones.
  if (JSON.stringify(evaluation.before) !== JSON.stringify(guide.value.guide?.vectors)) return null;
  return (
    <div data-test={`manual-result-${from}`}>
      {evaluation.acceptance && <Acceptance evaluation={evaluation} />}
      {evaluation.accepted === true && <p role="status">{t.manualAccepted}</p>}
      {evaluation.changes.length > 0 && (
        <table aria-label={t.vectors}>
          <thead><tr><th>{t.vectorOf}</th><th />{[t.before, t.after, t.change].map((name) => <th class="right" key={name}>{name}</th>)}</tr></thead>
          <tbody>
            {offsetRows(evaluation.before, evaluation.after).map((row) => (
              <tr key={row.axis + row.component}>
                <th scope="row">{row.axis}</th><td>{row.component}</td>
                <td class="right digits">{fixed(row.before, 4)}</td>
                <td class="right digits">{fixed(row.after, 4)}</td>
                <td class="right digits">{micrometres(row.after - row.before)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {evaluation.changes.length > 0 && (
        <p class="dim">{t.parametersThatChange}: {evaluation.changes.map((one) => `${sixDigits(one.number)} ${words(one.name)} ${fixed(one.after, 4)}`).join(", ")}</p>
      )}
      {evaluation.changes.length === 0 && evaluation.accepted !== true && <p role="status">{t.noChange}</p>}
      {evaluation.changes.length > 0 && (
        <div class="row">
          <button class="primary" data-test={`manual-write-${from}`} disabled={lacking("builder") !== ""}
            onClick={() => ask(t.manualWriteQuestion(evaluation.changes.length), t.measurementConfirm, () => void write(from, number))}>
            {t.measurementConfirm}
          </button>
          <GuardNote needs="builder" />
        </div>
      )}
    </div>
  );
}

function Steps({ guide, number }: { guide: ManualGuide; number: number }) {
  const t = text.value;
  const wrong = wrongReadings(guide, notes.value.readings);
  return (
    <>
      <h3>{t.manualSteps}</h3>
      <ol class="manual-steps">
        {guide.steps.map((step, i) => (
          <li key={i}>
            <b>{step.at}</b> <span class="dim">{step.use}</span>
            <p>{step.do}</p>
            <div class="manual-fields">{step.readings.map((reading) => <Field key={reading.name} reading={reading} wrong={wrong.includes(reading.name)} />)}</div>
          </li>
        ))}
      </ol>
      <div class="manual-fields">{guide.values.map((reading) => <Field key={reading.name} reading={reading} wrong={wrong.includes(reading.name)} />)}</div>
      <div class="row">
        <button data-test="manual-compute" disabled={wrong.length > 0} onClick={() => void evaluate("readings", number)}>{t.manualCompute}</button>
        {wrong.length > 0 && <span class="dim">{t.manualMissing(wrong.length)}</span>}
      </div>
      <Result from="readings" number={number} />
    </>
  );
}

function NinePoses({ guide, number }: { guide: ManualGuide; number: number }) {
  const t = text.value;
  const { displacements, alpha } = notes.value;
  const wrong = displacements.flat().filter(wrongDisplacement).length;
  const type = (pose: number, component: number, value: string) =>
    note({ displacements: displacements.map((row, i) => (i === pose ? row.map((one, j) => (j === component ? value : one)) : row)) });
  return (
    <>
      <h3>{t.manualNinePoses}</h3>
      <p class="dim">{t.manualNinePosesAbout}</p>
      {guide.kind === "ac-table" && (
        <div class="manual-fields">
          <label>
            <span>{t.manualAlpha}</span>
            <input class="digits" inputMode="numeric" data-test="manual-check-alpha" aria-invalid={wrongAlpha(alpha)} value={alpha} onInput={(event) => note({ alpha: event.currentTarget.value })} />
            <span class="dim">°</span>
          </label>
        </div>
      )}
      <table aria-label={t.manualNinePoses} class="manual-poses">
        <thead><tr><th>{t.pose}</th>{[..."XYZ"].map((letter) => <th class="right" key={letter}>{letter}, mm</th>)}</tr></thead>
        <tbody>
          {guide.poses.map((pose, i) => (
            <tr key={i}>
              <th scope="row" class="digits">{pose}</th>
              {[..."XYZ"].map((letter, j) => {
                const value = displacements[i]![j]!;
                return (
                  <td key={letter}>
                    <input class="digits" inputMode="decimal" autocomplete="off" aria-label={`${pose} ${letter}`} data-test={`manual-pose-${i}-${letter}`}
                      aria-invalid={value !== "" && wrongDisplacement(value)} value={value} onInput={(event) => type(i, j, event.currentTarget.value)} />
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
      <div class="row">
        <button data-test="manual-evaluate" disabled={wrong > 0 || wrongAlpha(alpha)} onClick={() => void evaluate("displacements", number)}>{t.manualEvaluate}</button>
        {wrong > 0 && <span class="dim">{t.manualMissing(wrong)}</span>}
      </div>
      <Result from="displacements" number={number} />
    </>
  );
}

export function ManualCalibration() {
  const t = text.value;
  const number = channel.value?.channel;
  const { parameters, pending } = machine.value.revisions;
  const { alpha } = notes.value;
  const spoken = language.value;
  useEffect(() => {
    if (number !== undefined) void readGuide(number, alpha);
  }, [number, alpha, spoken, parameters, pending]);
  const { guide: found, reason } = guide.value;
  if (!found || number === undefined || notes.value.kind !== found.kind)
    return <section class="manual"><p role="status">{reason}</p></section>;
  return (
    <section class="manual" aria-label={t.manualCalibration}>
      <div class="title">
        <h2>{found.title}</h2>
        <button class="end" onClick={() => ask(t.manualClearQuestion, t.manualClear, () => (notes.value = emptyNotes(found.kind)))}>{t.manualClear}</button>
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label={found.title}>
        <Guard needs="setter">
          <h3>{t.manualChecks}</h3>
          <Checks checks={found.checks} />
          <Steps guide={found} number={number} />
          <NinePoses guide={found} number={number} />
        </Guard>
      </div>
    </section>
  );
}
