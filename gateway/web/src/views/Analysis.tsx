// SPDX-License-Identifier: Apache-2.0
// Signals sampled from the machine, and recordings: of the machine, or exported as CSV.
import { signal } from "@preact/signals";
import type { ComponentChild } from "preact";
import { useRef } from "preact/hooks";
import { axesOf } from "../analysis/offered";
import { openFile } from "../analysis/open_file";
import { type Recording, type Source, withLetters } from "../analysis/recording";
import { difference, largest, startOfMotion } from "../analysis/signals";
import { shortNumber } from "../format";
import { cyclePeriod } from "../state/cycle_period";
import { channel, tell } from "../state/store";
import { text } from "../text/texts";
import { Recordings } from "./Recordings";
import { RecordingView } from "./RecordingView";
import { Sampling } from "./Sampling";

const shown = signal<"live" | "file">("live");
const first = signal<Recording | null>(null);
const second = signal<Recording | null>(null);
const view = signal<"first" | "second" | "difference">("first");
const alignment = signal<"start" | "cycle">("start");
const loading = signal<{ name: string; cancel: () => void } | null>(null);
/** Of the file opened last, for whoever asks how long it took: ms. */
const took = signal(0);

async function open(source: Source, into: typeof first): Promise<boolean> {
  const t = text.peek();
  const began = performance.now();
  const { result, cancel } = openFile(source, cyclePeriod.peek() ?? 0.001);
  const mine = { name: source.name, cancel };
  loading.value = mine;
  const opened = await result;
  if (loading.peek() !== mine) return false;
  loading.value = null;
  took.value = performance.now() - began;
  if ("recording" in opened) {
    into.value = withLetters(opened.recording, channel.peek()?.letters ?? "");
    return true;
  }
  const reasons: Record<string, string> = { empty: t.csvEmpty, "no-cycle": t.csvNoCycle, "no-number": t.csvNoNumber };
  tell(`${source.name}:${opened.line > 0 ? `${opened.line}:` : ""} ${reasons[opened.what] ?? opened.what}`, true);
  return false;
}

const openFirst = (source: Source) => void open(source, first).then((good) => good && ((second.value = null), (view.value = "first")));
const openSecond = (source: Source) => void open(source, second).then((good) => good && (view.value = "difference"));
/** The list in place of an open recording; without one it is always shown. */
const listed = signal(false);

const derived = signal<{ a: Recording; b: Recording; how: string; made: Recording } | null>(null);

/** Kept until another file or alignment is chosen. */
function differenceOf(a: Recording, b: Recording, letters: string): Recording {
  const how = alignment.value;
  const known = derived.peek();
  if (known && known.a === a && known.b === b && known.how === how) return known.made;
  const start = (one: Recording) => one.cycles[startOfMotion([...axesOf(one, letters).positions.values()])] ?? 0;
  const made = { ...difference(a, b, how === "cycle" ? 0 : start(b) - start(a)), name: `${a.name}-difference` };
  derived.value = { a, b, how, made };
  return made;
}

function FileButton({ title, chosen }: { title: string; chosen: (file: File) => void }) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button onClick={() => input.current?.click()}>{title}</button>
      <input
        ref={input}
        type="file"
        accept=".csv,text/csv"
        hidden
        aria-label={title}
        onChange={(event) => {
          const file = event.currentTarget.files?.[0];
          event.currentTarget.value = "";
          if (file) chosen(file);
        }}
      />
    </>
  );
}

function Files({ tabs, letters }: { tabs: ComponentChild; letters: string }) {
  const t = text.value;
  const [a, b] = [first.value, second.value];
  const both = a !== null && b !== null;
  const recording = view.value === "second" && b ? b : view.value === "difference" && both ? differenceOf(a, b, letters) : a;
  const worst = view.value === "difference" && recording
    ? recording.columns.filter(({ name }) => /actual|setpoint|commanded/.test(name)).map(({ name, values }) => ({ name, value: values[largest(values) ?? 0] ?? NaN })) : [];
  return (
    <>
      <section class="sampling-keys" aria-label={t.recordings}>
        {tabs}
        {recording && <button aria-pressed={listed.value} onClick={() => (listed.value = !listed.value)}>{t.recordingsOf}</button>}
        <FileButton title={t.openRecording} chosen={(file) => openFirst({ name: file.name, file })} />
        {a && <FileButton title={t.openSecond} chosen={(file) => openSecond({ name: file.name, file })} />}
        {loading.value && (
          <>
            <span role="status">{t.reading(loading.value.name)}</span>
            <button
              onClick={() => {
                loading.peek()?.cancel();
                loading.value = null;
              }}
            >
              {t.cancel}
            </button>
          </>
        )}
        {a && !both && <b>{a.name}</b>}
        {both && (
          <>
            <div class="segments" role="group" aria-label={t.whichRecording}>
              <button aria-pressed={view.value === "first"} onClick={() => (view.value = "first")}>{a.name}</button>
              <button aria-pressed={view.value === "second"} onClick={() => (view.value = "second")}>{b.name}</button>
              <button aria-pressed={view.value === "difference"} onClick={() => (view.value = "difference")}>{t.differenceOf}</button>
            </div>
            <select aria-label={t.alignment} value={alignment.value} onChange={(event) => (alignment.value = event.currentTarget.value as "start" | "cycle")}>
              <option value="start">{t.alignStart}</option>
              <option value="cycle">{t.alignCycle}</option>
            </select>
          </>
        )}
        {worst.length > 0 && <span class="digits" data-test="worst">{t.largestDifference} {worst.map(({ name, value }) => `${name.replace(/^\u0394 /, "")} ${shortNumber(value)}`).join("  ")}</span>}
        <span data-test="took" data-milliseconds={took.value} hidden />
      </section>
      {recording && !listed.value ? (
        <RecordingView recording={recording} letters={letters} />
      ) : (
        <Recordings
          opened={(source) => ((listed.value = false), openFirst(source))}
          compared={a ? (source) => ((listed.value = false), openSecond(source)) : null}
        />
      )}
    </>
  );
}

export function Analysis() {
  const t = text.value;
  const letters = channel.value?.letters ?? "";
  const tabs = (
    <div class="segments" role="tablist" aria-label={t.viewAnalysis}>
      <button role="tab" aria-selected={shown.value === "live"} onClick={() => (shown.value = "live")}>{t.sampling}</button>
      <button role="tab" aria-selected={shown.value === "file"} onClick={() => (shown.value = "file")}>{t.recordings}</button>
    </div>
  );
  return <main class="analysis">{shown.value === "live" ? <Sampling tabs={tabs} /> : <Files tabs={tabs} letters={letters} />}</main>;
}
