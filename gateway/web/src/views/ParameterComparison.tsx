// SPDX-License-Identifier: Apache-2.0
// What another set of parameters has that this machine has not, before it is taken over.
import { useSignal } from "@preact/signals";
import { type Answer, get, put, putIfSame } from "../api";
import type { Parameter } from "../contract";
import { limits, refusal, title, unit } from "../format";
import { type ComparedRow, importBodies, type ParameterFile, sixDigits, storedValue, type Verdict } from "../state/parameter_file";
import { tell } from "../state/store";
import { changedSince, remember } from "../state/undo";
import { text, type Texts } from "../text/texts";
import { lacking } from "./Guard";
import { ask } from "./Question";

export interface Comparison {
  /** A file's name, or the defaults. */
  what: string;
  rows: ComparedRow[];
  bad: ParameterFile["bad"];
  /** The defaults of all parameters make no machine: they are looked at only. */
  takeable: boolean;
}

const mostRows = 500;
const attempts = 8, betweenAttempts = 200;  // ms

const readAll = () => get<{ parameters: Parameter[] }>("/api/parameters?limit=100000");

export async function allParameters(): Promise<Parameter[] | undefined> {
  const answer = await readAll();
  if (!answer.body) tell(refusal(text.peek().parameters, answer.reason), true);
  return answer.body?.parameters;
}

type Value = ReturnType<typeof storedValue>;

/** Stores rows while the parameters have the values of `before`, and nothing else may come between. */
async function sendAll(rows: ComparedRow[], before: Map<number, Value>): Promise<Answer> {
  let answer: Answer = { ok: true, status: 200, body: undefined, reason: "" };
  // Others may be written all the time, as temperatures are: then the values are read and compared again.
  for (let attempt = 0; attempt < attempts; ++attempt) {
    const now = await readAll();
    if (!now.body) return now;
    if (now.body.parameters.some((one) => before.has(one.number) && storedValue(one) !== before.get(one.number))) return changedSince();
    const [first, ...rest] = importBodies(rows);
    if (first) answer = await putIfSame("/api/parameters", { values: first }, now.tag);
    if (answer.status === 412) {
      await new Promise((resolve) => setTimeout(resolve, betweenAttempts));
      continue;
    }
    for (const values of rest) if (answer.ok) answer = await put("/api/parameters", { values });
    return answer;
  }
  return answer;
}

/** Stores every row that differs; the whole can be taken back. */
async function takeOver(what: string, rows: ComparedRow[]): Promise<Answer> {
  const wanted = rows.filter(({ verdict }) => verdict === "differs");
  const before = new Map(wanted.map(({ number, parameter }) => [number, storedValue(parameter!)]));
  const answer = await sendAll(wanted, before);
  if (!answer.ok) return answer;
  const after = new Map(wanted.map(({ number, there, parameter }) => [number, parameter!.type === "text" ? there : Number(there)]));
  const back = wanted.map((row) => ({ ...row, there: String(storedValue(row.parameter!)) }));
  remember({ what, undo: () => sendAll(back, after) });
  return answer;
}

function saysOf(t: Texts, verdict: Verdict, parameter: Parameter | undefined): string {
  const range = parameter ? limits(parameter.minimum, parameter.maximum) : "";
  const says: Record<Verdict, string> = {
    differs: "", same: "", unknown: t.verdictUnknown, "not-a-number": t.notANumber, limits: t.verdictLimits(range), whole: t.verdictWhole,
    twice: t.verdictTwice, "only-here": t.verdictOnlyHere,
  };
  return says[verdict];
}

interface Props {
  comparison: Comparison;
  choose: (number: number) => void;
  /** Something was stored. */
  done: () => void;
  close: () => void;
}

export function ParameterComparison({ comparison, choose, done, close }: Props) {
  const busy = useSignal(false);
  const t = text.value;
  const { what, rows, bad } = comparison;
  const count = rows.filter(({ verdict }) => verdict === "differs").length;
  const rejected = rows.filter(({ verdict }) => verdict !== "differs" && verdict !== "only-here").length + bad.length;
  const take = () =>
    ask(t.takeOverQuestion(count, what), t.takeOver(count), () => {
      busy.value = true;
      void takeOver(t.takenOver(count, what), rows).then((answer) => {
        busy.value = false;
        tell(answer.ok ? t.takenOver(count, what) : refusal(what, answer.reason), !answer.ok);
        if (answer.ok) done();
      });
    });
  return (
    <section class="list" aria-label={t.comparison}>
      <div class="title">
        <h2>{t.comparedWithSet(what)}</h2>
        <span class="dim" data-test="compared">{t.comparedCounts(count, rejected)}</span>
        <div class="end">
          {comparison.takeable && <button class="primary" disabled={count === 0 || busy.value || lacking("setter") !== ""} onClick={take}>{t.takeOver(count)}</button>}
          <button onClick={close}>{t.endComparison}</button>
        </div>
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.comparison}>
        <table>
          <thead>
            <tr><th>{t.number}</th><th>{t.name}</th><th class="right">{t.here}</th><th class="right">{t.there}</th><th>{t.unit}</th><th /></tr>
          </thead>
          <tbody>
            {bad.map(({ line, text: content }) => (
              <tr key={`line ${line}`} class="dead"><td colSpan={5}>{t.badLine(line, content)}</td><td>{t.verdictNoParameter}</td></tr>
            ))}
            {rows.slice(0, mostRows).map(({ number, parameter, there, verdict }, index) => (
              <tr key={`${number}/${index}`} class={verdict === "differs" || verdict === "only-here" ? "" : "dead"} data-verdict={verdict}>
                <td><button disabled={!parameter} onClick={() => choose(number)}>{sixDigits(number)}</button></td>
                <td>{parameter ? title(parameter.name) : ""}</td>
                <td class="right digits" title={parameter ? String(storedValue(parameter)) : ""}>{parameter ? String(storedValue(parameter)) : ""}</td>
                <td class="right digits" title={there}>{there}</td>
                <td class="dim">{parameter ? unit(parameter.unit, t.or) : ""}</td>
                <td>{saysOf(t, verdict, parameter)}</td>
              </tr>
            ))}
          </tbody>
        </table>
        {rows.length > mostRows && <p class="dim">{t.shownOf(mostRows, rows.length)}</p>}
        {rows.length + bad.length === 0 && <p class="dim">{t.nothingDiffers}</p>}
      </div>
    </section>
  );
}
