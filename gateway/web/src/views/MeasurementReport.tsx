// SPDX-License-Identifier: Apache-2.0
// The result of a measurement: deviations of the poses as plot and table, vectors, parameters that change, protocol.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get } from "../api";
import type { MeasurementChange, MeasurementPose, MeasurementResult, Parameter } from "../contract";
import { fixed, title as words } from "../format";
import { inclination, lettersOf, micrometres, poseName, type Shown, vectorRows } from "../measurement/result";
import { sixDigits } from "../state/parameter_file";
import { channels } from "../state/store";
import { text } from "../text/texts";
import { ResidualPlot } from "./ResidualPlot";

const shown = signal<Shown>("residual");
/** Names of parameters by number. */
const names = signal<Map<number, string>>(new Map());

async function askNames(changes: MeasurementChange[]): Promise<void> {
  const unknown = changes.filter(({ number }) => !names.peek().has(number));
  const answers = await Promise.all(unknown.map(({ number }) => get<Parameter>(`/api/parameters/${number}`)));
  const found = answers.flatMap((answer, i) => (answer.body?.name ? [[unknown[i]!.number, words(answer.body.name)] as const] : []));
  if (found.length > 0) names.value = new Map([...names.peek(), ...found]);
}

const three = (values: number[], show: (value: number) => string) =>
  [0, 1, 2].map((i) => <td class="right digits" key={i}>{values[i] === undefined ? "–" : show(values[i])}</td>);

function Poses({ poses, letters }: { poses: MeasurementPose[]; letters: string[] }) {
  const t = text.value;
  const groups = [t.centreMm, t.differenceUm, t.residualUm];
  return (
    <>
      <h3>{t.poses}</h3>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.poses}>
        <table aria-label={t.poses}>
          <thead>
            <tr><th rowSpan={2}>{t.pose}</th>{groups.map((group) => <th colSpan={3} key={group}>{group}</th>)}<th rowSpan={2} class="right">{t.diameterMm}</th></tr>
            <tr>{groups.map((group) => [..."XYZ"].map((letter) => <th class="right" key={group + letter}>{letter}</th>))}</tr>
          </thead>
          <tbody>
            {poses.map((pose, i) => (
              <tr key={i}>
                <th scope="row" class="digits">{poseName(pose, letters)}</th>
                {three(pose.centre, (value) => fixed(value, 4))}
                {three(pose.difference, micrometres)}
                {three(pose.residual, micrometres)}
                <td class="right digits">{pose.diameter > 0 ? fixed(pose.diameter, 4) : "–"}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </>
  );
}

function Vectors({ result }: { result: MeasurementResult }) {
  const t = text.value;
  return (
    <>
      <h3>{t.vectors}</h3>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.vectors}>
        <table aria-label={t.vectors}>
          <thead>
            <tr><th>{t.vectorOf}</th><th />{[t.before, t.after, t.change, t.uncertainty].map((name) => <th class="right" key={name}>{name}</th>)}</tr>
          </thead>
          <tbody>
            {vectorRows(result.vectors).map((row) => (
              <tr key={row.axis + row.component}>
                <th scope="row">{row.axis}</th><td>{row.component}</td>
                <td class="right digits">{fixed(row.before, 4)}</td>
                <td class="right digits">{fixed(row.after, 4)}</td>
                <td class="right digits">{micrometres(row.change)}</td>
                <td class="right digits">{micrometres(row.uncertainty).replace("+", "")}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {result.vectors.map((vector) => <p class="dim" key={vector.axis}>{t.inclinationOf(vector.axis, fixed(inclination(vector), 0))}</p>)}
    </>
  );
}

function Changes({ changes }: { changes: MeasurementChange[] }) {
  const t = text.value;
  useEffect(() => void askNames(changes), [changes]);
  if (changes.length === 0) return <p>{t.noChange}</p>;
  return (
    <>
      <h3>{t.parametersThatChange}</h3>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.parametersThatChange}>
        <table aria-label={t.parametersThatChange}>
          <thead><tr><th>{t.number}</th><th>{t.name}</th><th class="right">{t.valueBefore}</th><th class="right">{t.valueAfter}</th></tr></thead>
          <tbody>
            {changes.map(({ number, before, after }) => (
              <tr key={number}>
                <th scope="row" class="digits">{sixDigits(number)}</th><td>{names.value.get(number) ?? ""}</td>
                <td class="right digits">{fixed(before, 6)}</td><td class="right digits">{fixed(after, 6)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </>
  );
}

function Protocol({ result }: { result: MeasurementResult }) {
  const t = text.value;
  const download = () => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([result.protocol], { type: "text/plain" }));
    link.download = `kinematics-${result.measurement}.txt`;
    link.click();
    URL.revokeObjectURL(link.href);
  };
  return (
    <>
      <div class="title"><h3>{t.protocol}</h3><button class="end" onClick={download}>{t.downloadProtocol}</button></div>
      <pre class="protocol scroll" tabIndex={0} role="region" aria-label={t.protocol}>{result.protocol}</pre>
    </>
  );
}

export function MeasurementReport({ result, channelOf }: { result: MeasurementResult | undefined; channelOf: number }) {
  const t = text.value;
  const poses = result?.poses ?? [];
  const letters = result ? lettersOf(result, channels.value[String(channelOf)]?.letters ?? "") : [];
  const options = [["difference", t.shownDifference], ["residual", t.shownResidual]] as const;
  return (
    <section class="measurement-report" aria-label={t.measurementResult}>
      <div class="title">
        <h2>{t.measurementResult}</h2>
        {result?.valid && <span class="digits">{t.deviationOfTouch(micrometres(result.touch_deviation).replace("+", ""))}, {t.largestChange(fixed(result.largest_change, 4))}</span>}
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.measurementResult}>
        {poses.length === 0 && <p class="dim">{t.noResult}</p>}
        {result?.valid && (
          <>
            <div class="title">
              <h3>{t.residuals}</h3>
              <div class="segments end">
                {options.map(([what, name]) => <button key={what} aria-pressed={shown.value === what} onClick={() => (shown.value = what)}>{name}</button>)}
              </div>
            </div>
            <ResidualPlot poses={poses} letters={letters} shown={shown.value} deviation={result.touch_deviation * 1000} />
            <Vectors result={result} />
            <Changes changes={result.changes} />
          </>
        )}
        {poses.length > 0 && <Poses poses={poses} letters={letters} />}
        {result?.valid && <Protocol result={result} />}
      </div>
    </section>
  );
}
