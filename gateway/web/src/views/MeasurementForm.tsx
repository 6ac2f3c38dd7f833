// SPDX-License-Identifier: Apache-2.0
// Inputs of a measurement: the common ones as fields, all of them as YAML. What is shown is what is sent.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { get, post } from "../api";
import type { MeasurementOffer, MeasurementState } from "../contract";
import { limits as rangeText } from "../format";
import {
  angleLimits, type Fault, faultsOf, type Fields, fieldsOf, inputsOf, type Limits, modes, type Place, pointLimits, probeLimits,
  type Refusal, refusalOf, sphereLimits, yamlOf,
} from "../measurement/inputs";
import { givesUp, possibleOrders } from "../measurement/progress";
import { channelNumber } from "../state/store";
import { text } from "../text/texts";
import { Guard, lacking } from "./Guard";
import { ask } from "./Question";

const mostShown = 7200;  // deg: who turns further has no end worth naming

/** What is typed is kept while other views are shown. */
const offer = signal<MeasurementOffer | null>(null);
const notOffered = signal("");
const fields = signal<Fields | null>(null);
const yaml = signal<string | null>(null);
const asYaml = signal(false);
const retract = signal(false);
const refusal = signal<Refusal | null>(null);

async function askOffer(channel: number): Promise<void> {
  const answer = await get<MeasurementOffer>(`/api/measurement/inputs?channel=${channel}`);
  notOffered.value = answer.reason;
  if (!answer.ok || !answer.body) return;
  const other = offer.peek()?.channel !== channel;
  offer.value = answer.body;
  if (other || !fields.peek()) fields.value = fieldsOf(answer.body.inputs);
}

function faultText(fault: Fault, limits: Limits): string {
  const t = text.value;
  const texts: Record<Fault, string> = {
    number: t.notANumber, whole: t.notAWholeNumber, order: t.startBelowEnd, limits: t.outsideLimits(rangeText(limits[0], limits[1])),
  };
  return texts[fault];
}

interface FieldProps {
  place: Place;
  label: string;
  value: string;
  limits: Limits;
  faults: Map<Place, Fault>;
  change: (typed: string) => void;
}

/** What is sent, once for the key that starts and for the text that the fields become. */
const fieldYaml = (now: Fields | null, known: MeasurementOffer | null): string =>
  now && known && faultsOf(now, known.travel).size === 0 ? yamlOf(inputsOf(known.inputs, now)) : yamlOf(known?.inputs ?? {});

/** Beside the keys of the measurement, so that it is reached wherever the form is scrolled to. */
export function StartKey({ state }: { state: MeasurementState }) {
  const t = text.value;
  const now = fields.value;
  const known = offer.value;
  const faulty = !asYaml.value && now !== null && known !== null && faultsOf(now, known.travel).size > 0;
  const blocked = lacking("setter") || (faulty ? t.correctFields : "");
  const start = async () => {
    refusal.value = null;
    const inputs = asYaml.value ? yaml.value : fieldYaml(now, known);
    const answer = await post("/api/measurement/start", { channel: channelNumber.peek(), inputs, retract: retract.value });
    if (!answer.ok) refusal.value = refusalOf(answer.reason);
  };
  const begin = () => {
    if (!givesUp(state) || (!asYaml.value && now?.mode === "only_correct")) void start();
    else ask(t.startAnewQuestion, t.measurementStart, () => void start());
  };
  return (
    <button class={givesUp(state) ? "" : "primary"} disabled={!possibleOrders(state).start || blocked !== "" || (!known && !asYaml.value)} title={blocked || undefined} onClick={begin}>
      {t.measurementStart}
    </button>
  );
}

/** A number with its limits as a tool tip, and what is wrong with it below once something is typed. */
function NumberField({ place, label, value, limits, faults, change }: FieldProps) {
  const fault = faults.get(place);
  const id = `measurement-${place.replace(".", "-")}`;
  return (
    <>
      <input
        class="short digits" aria-label={label} inputMode="decimal" value={value} title={rangeText(limits[0], limits[1])}
        aria-invalid={fault !== undefined} aria-describedby={fault && value !== "" ? id : undefined}
        onInput={(event) => {
          refusal.value = null;
          change(event.currentTarget.value);
        }}
      />
      {fault && value !== "" && <small id={id} class="fault">{faultText(fault, limits)}</small>}
    </>
  );
}

function RangeTable({ now, faults }: { now: Fields; faults: Map<Place, Fault> }) {
  const t = text.value;
  const travel = offer.value?.travel ?? {};
  const change = (letter: string, what: "start" | "end" | "points", typed: string) =>
    (fields.value = { ...now, axes: now.axes.map((range) => (range.letter === letter ? { ...range, [what]: typed } : range)) });
  return (
    <table class="ranges">
      <thead><tr><th>{t.rotaryRanges}</th>{[t.rangeStart, t.rangeEnd, t.rangePoints].map((title) => <th class="right" key={title}>{title}</th>)}</tr></thead>
      <tbody>
        {now.axes.map((range) => {
          const limits = angleLimits(travel, range.letter);
          const refused = refusal.value?.axis === range.letter;
          return (
            <tr key={range.letter} class={refused ? "refused" : ""}>
              <th scope="row">{range.letter}{limits[1] - limits[0] < mostShown && <div class="dim">{rangeText(limits[0], limits[1])}°</div>}</th>
              {([["start", t.rangeStart, limits], ["end", t.rangeEnd, limits], ["points", t.rangePoints, pointLimits]] as const).map(([what, title, bounds]) => (
                <td class="right" key={what}>
                  <NumberField
                    place={`${range.letter}.${what}`} label={t.rangeField(range.letter, title.replace(" °", ""))} value={range[what]} limits={bounds} faults={faults}
                    change={(typed) => change(range.letter, what, typed)}
                  />
                </td>
              ))}
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function FieldForm({ now, faults }: { now: Fields; faults: Map<Place, Fault> }) {
  const t = text.value;
  const modeNames = { measure_only: t.modeMeasureOnly, correct: t.modeCorrect, only_correct: t.modeOnlyCorrect };
  return (
    <>
      <label class="row">
        <span class="name">{t.measurementMode}</span>
        <select value={now.mode} onChange={(event) => (fields.value = { ...now, mode: event.currentTarget.value as Fields["mode"] })}>
          {modes.map((mode) => <option key={mode} value={mode}>{modeNames[mode]}</option>)}
        </select>
      </label>
      <fieldset class="row">
        <legend>{t.sphereCentre} <span class="dim">{t.workpieceMm}, ±{sphereLimits[1]}</span></legend>
        {[..."XYZ"].map((letter, i) => (
          <span class="of-axis" key={letter}>
            <span aria-hidden="true">{letter}</span>
            <NumberField
              place={letter} label={t.sphereOf(letter)} value={now.sphere[i]!} limits={sphereLimits} faults={faults}
              change={(typed) => (fields.value = { ...now, sphere: now.sphere.map((old, k) => (k === i ? typed : old)) as Fields["sphere"] })}
            />
          </span>
        ))}
      </fieldset>
      <div class="row of-probe">
        <span class="name">{t.probeLength} <span class="dim">{t.probeLengthAbout}, {rangeText(...probeLimits)}</span></span>
        <NumberField place="probe" label={t.probeLength} value={now.probeLength} limits={probeLimits} faults={faults} change={(typed) => (fields.value = { ...now, probeLength: typed })} />
      </div>
      <RangeTable now={now} faults={faults} />
    </>
  );
}

function YamlForm() {
  const t = text.value;
  const area = useRef<HTMLTextAreaElement>(null);
  const line = refusal.value?.line ?? 0;
  // The line that is refused is marked in the text.
  useEffect(() => {
    if (line === 0 || !area.current) return;
    const lines = area.current.value.split("\n");
    const from = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
    area.current.focus();
    area.current.setSelectionRange(from, from + (lines[line - 1]?.length ?? 0));
    area.current.scrollTop = Math.max(0, (line - 4) * 20);
  }, [refusal.value]);
  return (
    <textarea
      ref={area} class="inputs-yaml" aria-label={t.measurementInputs} spellcheck={false} value={yaml.value ?? ""} aria-invalid={line > 0}
      onInput={(event) => {
        refusal.value = null;
        yaml.value = event.currentTarget.value;
      }}
    />
  );
}

export function MeasurementForm() {
  const t = text.value;
  const number = channelNumber.value;
  useEffect(() => {
    if (number !== null) void askOffer(number);
  }, [number]);
  const now = fields.value;
  const known = offer.value;
  const faults = now && known ? faultsOf(now, known.travel) : new Map<Place, Fault>();
  const show = (text: boolean) => {
    if (text && yaml.value === null) yaml.value = fieldYaml(now, known);
    asYaml.value = text;
    refusal.value = null;
  };
  return (
    <section class="measurement-form" aria-label={t.measurementInputs}>
      <div class="title">
        <h2>{t.measurementInputs}</h2>
        <Guard needs="setter">
          {asYaml.value ? (
            <button class="end" title={t.fillsYamlAbout} disabled={!known} onClick={() => (yaml.value = fieldYaml(now, known))}>{t.fillsYaml}</button>
          ) : (
            <button class="end" title={t.machineInputsAbout} disabled={!known} onClick={() => known && (fields.value = fieldsOf(known.inputs))}>{t.machineInputs}</button>
          )}
        </Guard>
        <div class="segments">
          <button aria-pressed={!asYaml.value} onClick={() => show(false)}>{t.inputFields}</button>
          <button aria-pressed={asYaml.value} onClick={() => show(true)}>{t.inputYaml}</button>
        </div>
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.measurementInputs}>
        {notOffered.value !== "" && <p class="refusal" role="status">{notOffered.value}</p>}
        <Guard needs="setter">{asYaml.value ? <YamlForm /> : now && <FieldForm now={now} faults={faults} />}</Guard>
      </div>
      <Guard needs="setter">
        <div class="row">
          <button aria-pressed={retract.value} onClick={() => (retract.value = !retract.value)}>{t.retract}</button>
          <span class="dim about">{t.retractAbout}</span>
        </div>
      </Guard>
      {refusal.value && (
        <p class="refusal" role="alert">{t.inputsRefused}: {asYaml.value && refusal.value.line > 0 ? `${t.inLine(refusal.value.line)} ` : ""}{refusal.value.text}</p>
      )}
      {!asYaml.value && faults.size > 0 && <p class="tag warn">{t.correctFields}</p>}
    </section>
  );
}
