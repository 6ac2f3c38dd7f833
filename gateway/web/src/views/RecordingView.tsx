// SPDX-License-Identifier: Apache-2.0
// A recording: waveforms with cursors, path in 3D, table and spectrum, with one selected row in all of them.
import { useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { axesOf, offeredSignals, type Signal } from "../analysis/offered";
import { csvOf, type Recording, rowAt, secondsOf } from "../analysis/recording";
import { mostSignals } from "../analysis/sampler";
import { envelope, largest, type Quantity, spectrum } from "../analysis/signals";
import { fixed, shortNumber } from "../format";
import { text, type Texts } from "../text/texts";
import { RecordedScene } from "./RecordedScene";
import { SampleTable } from "./SampleTable";
import { type Lane, type Mark, Waveforms } from "./Waveforms";

const buckets = 1200;

export function quantityName(t: Texts, quantity: Quantity): string {
  return { speed: t.pathSpeed, acceleration: t.pathAcceleration, jerk: t.pathJerk, following: t.followingError }[quantity];
}

function Cursors({ recording, signals, a, b }: { recording: Recording; signals: Signal[]; a: number; b: number | null }) {
  const t = text.value;
  const at = (row: number | null, signal: Signal) => (row === null ? NaN : (signal.values()[row] ?? NaN));
  return (
    <section class="cursors" aria-label={t.cursors}>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.cursors}>
        <table class="digits">
          <thead><tr><th>{t.cursors}</th><th class="right">A</th><th class="right">B</th><th class="right">B − A</th></tr></thead>
          <tbody>
            <tr>
              <td>s</td>
              <td class="right">{fixed(secondsOf(recording, a), 4)}</td>
              <td class="right">{b === null ? "–" : fixed(secondsOf(recording, b), 4)}</td>
              <td class="right" data-test="cursor-time">{b === null ? "–" : (secondsOf(recording, b) - secondsOf(recording, a)).toFixed(4)}</td>
            </tr>
            {signals.map((signal) => (
              <tr key={signal.name}>
                <td>{signal.name}</td>
                <td class="right">{shortNumber(at(a, signal))}</td>
                <td class="right">{shortNumber(at(b, signal))}</td>
                <td class="right">{shortNumber(at(b, signal) - at(a, signal))}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function Chooser({ offered, chosen, toggle }: { offered: Signal[]; chosen: string[]; toggle: (name: string) => void }) {
  const t = text.value;
  return (
    <details class="chooser">
      <summary>{t.signals(chosen.length)}</summary>
      <div class="scroll" tabIndex={0} role="group" aria-label={t.signalChoice}>
        {offered.map(({ name, unit }) => (
          <button key={name} aria-pressed={chosen.includes(name)} disabled={!chosen.includes(name) && chosen.length >= mostSignals} onClick={() => toggle(name)}>
            {name} {unit && <span class="dim">{unit}</span>}
          </button>
        ))}
      </div>
    </details>
  );
}

export function RecordingView({ recording, letters }: { recording: Recording; letters: string }) {
  const t = text.value;
  const axes = useMemo(() => axesOf(recording, letters), [recording, letters]);
  const offered = useMemo(() => offeredSignals(recording, axes, (quantity) => quantityName(t, quantity)), [recording, axes, t]);
  const chosen = useSignal<string[]>([]);
  const range = useSignal<[number, number]>([0, recording.cycles.length - 1]);
  const a = useSignal(0);
  const b = useSignal<number | null>(null);
  const second = useSignal(false);
  const shown = useSignal<"path" | "spectrum">("path");
  const of = useSignal("");
  const end = recording.cycles.length - 1;
  useEffect(() => {
    range.value = [0, end];
    [a.value, b.value] = [0, null];
    const kept = chosen.peek().filter((name) => offered.some((one) => one.name === name));
    const positions = offered.filter(({ name }) => /^(\u0394 )?(actual|setpoint|following)[.[]/.test(name));
    chosen.value = kept.length > 0 ? kept : (positions.length > 0 ? positions : offered).slice(0, 6).map(({ name }) => name);
  }, [recording]);

  const signals = offered.filter(({ name }) => chosen.value.includes(name));
  const [first, last] = [Math.min(range.value[0], end), Math.min(range.value[1], end)];
  const key = signals.map(({ name }) => name).join("\n");
  const lanes = useMemo((): Lane[] => {
    const made = envelope(recording, signals.map(({ values }) => values()), first, last, buckets);
    return signals.map(({ name, unit }, i) => ({ name, unit, x: made.x, y: made.y[i]! }));
  }, [recording, key, first, last]);
  const marks = useMemo((): Mark[] => [
    { at: secondsOf(recording, a.value), name: "A" }, ...(b.value === null ? [] : [{ at: secondsOf(recording, b.value), name: "B" }]),
  ], [recording, a.value, b.value]);
  const base = recording.cycles[0] ?? 0;
  const rowOf = (seconds: number) => rowAt(recording.cycles, base + Math.round(seconds / recording.period));
  const move = (row: number, other: boolean) => {
    const limited = Math.min(end, Math.max(0, row));
    if (other) b.value = limited;
    else a.value = limited;
  };
  const zoom = (factor: number, about: number) => {
    const centre = rowOf(about);
    const wanted = [centre - (centre - first) * factor, centre + (last - centre) * factor];
    const [from, to] = [Math.max(0, Math.floor(wanted[0]!)), Math.min(end, Math.ceil(wanted[1]!))];
    if (to - from >= 8 || factor > 1) range.value = [from, to];
  };
  const analysed = signals.find(({ name }) => name === of.value) ?? signals[0];
  const frequencies = useMemo(
    () => (shown.value === "spectrum" && analysed ? spectrum(analysed.values(), recording.cycles, recording.period, first, last) : undefined),
    [recording, shown.value, analysed, first, last],
  );
  const peak = frequencies && largest(frequencies.amplitudes);
  const spectrumLanes = useMemo(
    (): Lane[] => (frequencies && analysed ? [{ name: analysed.name, unit: analysed.unit, x: frequencies.frequencies, y: frequencies.amplitudes }] : []),
    [frequencies],
  );
  const spectrumMarks = useMemo((): Mark[] => (frequencies && peak ? [{ at: frequencies.frequencies[peak]!, name: "" }] : []), [frequencies, peak]);
  const save = () => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([csvOf({ ...recording, columns: signals.map(({ name, unit, values }) => ({ name, unit, values: values() })) }, first, last)], { type: "text/csv" }));
    link.download = `${recording.name.replace(/\.csv$/i, "")}-${recording.cycles[first]}.csv`;
    link.click();
    URL.revokeObjectURL(link.href);
  };
  return (
    <div class="recording">
      <section class="waves" aria-label={t.waveforms}>
        <div class="title">
          <Chooser offered={offered} chosen={chosen.value} toggle={(name) => (chosen.value = chosen.value.includes(name) ? chosen.value.filter((one) => one !== name) : [...chosen.value, name])} />
          <button aria-label={t.zoomIn} onClick={() => zoom(0.5, secondsOf(recording, a.value))}>+</button>
          <button aria-label={t.zoomOut} onClick={() => zoom(2, secondsOf(recording, a.value))}>−</button>
          <button onClick={() => (range.value = [0, end])}>{t.lockAll}</button>
          <button aria-pressed={second.value} aria-label={t.moveB} onClick={() => (second.value = !second.value)}>B</button>
          <button disabled={b.value === null} aria-label={t.rangeAB} onClick={() => b.value !== null && (range.value = [Math.min(a.value, b.value), Math.max(a.value, b.value)])}>A…B</button>
          <div class="end">
            <span class="dim digits" data-test="rows">{t.rowsOf(end + 1)}</span>
            <button onClick={save}>CSV</button>
          </div>
        </div>
        <Waveforms
          label={t.waveformsAbout} test="waveforms" lanes={lanes} unit="s" marks={marks} from={secondsOf(recording, first)} to={secondsOf(recording, last)}
          place={(at, shift) => move(rowOf(at), shift || second.value)} zoom={zoom}
          step={(rows, shift) => (shift || second.value ? move((b.value ?? a.value) + rows, true) : move(a.value + rows, false))}
        />
      </section>
      <div class="recording-side">
        <div class="segments" role="tablist" aria-label={t.pathAndSpectrum}>
          <button role="tab" aria-selected={shown.value === "path"} onClick={() => (shown.value = "path")}>{t.path}</button>
          <button role="tab" aria-selected={shown.value === "spectrum"} onClick={() => (shown.value = "spectrum")}>FFT</button>
        </div>
        {shown.value === "path" ? (
          axes.linear.length > 1 ? (
            <RecordedScene recording={recording} axes={axes} first={first} last={last} selected={a.value} select={(row) => move(row, false)} />
          ) : (
            <section class="dim" aria-label={t.recordedPath}>{t.noPath}</section>
          )
        ) : (
          <section aria-label={t.spectrum}>
            <div class="title">
              <select aria-label={t.spectrumOf} value={analysed?.name ?? ""} onChange={(event) => (of.value = event.currentTarget.value)}>
                {signals.map(({ name }) => <option key={name} value={name}>{name}</option>)}
              </select>
            </div>
            {frequencies ? (
              <Waveforms label={t.spectrum} test="spectrum" lanes={spectrumLanes} unit="Hz" marks={spectrumMarks} from={0} to={frequencies.frequencies[frequencies.frequencies.length - 1]!} />
            ) : (
              <p class="dim">{t.noSpectrum}</p>
            )}
            <p class="digits" data-test="peak">{frequencies && peak ? t.spectrumPeak(shortNumber(frequencies.frequencies[peak]!), `${shortNumber(frequencies.amplitudes[peak]!)} ${analysed?.unit ?? ""}`) : ""}</p>
          </section>
        )}
      </div>
      <SampleTable recording={recording} signals={signals} selected={a.value} select={(row) => move(row, false)} />
      <Cursors recording={recording} signals={signals} a={a.value} b={b.value} />
    </div>
  );
}
