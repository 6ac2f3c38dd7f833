// SPDX-License-Identifier: Apache-2.0
// Up to 16 signals of the running machine, with a trigger.
import { signal } from "@preact/signals";
import type { ComponentChild } from "preact";
import { useEffect } from "preact/hooks";
import { liveSignals, rowsOf } from "../analysis/live_signals";
import type { Recording } from "../analysis/recording";
import { mostSignals, Sampler, type Trigger } from "../analysis/sampler";
import { typedNumber } from "../format";
import { cyclePeriod } from "../state/cycle_period";
import { channel, machine, tell } from "../state/store";
import { text } from "../text/texts";
import { RecordingView } from "./RecordingView";

const chosen = signal<string[] | null>(null);
const edge = signal<Trigger["edge"]>("none");
const triggerOf = signal("");
const level = signal("0");
const seconds = signal("10");
const before = signal("20");
const running = signal<Sampler | null>(null);
const sampled = signal<Recording | null>(null);
const progress = signal({ state: "", rows: 0 });

let stopSampling: (() => void) | undefined;

function finish(): void {
  const sampler = running.peek();
  stopSampling?.();
  stopSampling = undefined;
  running.value = null;
  if (!sampler) return;
  sampler.stop();
  if (sampler.rows > 1) sampled.value = sampler.recording(`sample-${new Date().toISOString().slice(0, 19).replace(/:/g, "")}`, cyclePeriod.peek() ?? 0.001);
  else tell(text.peek().nothingSampled, true);
}

function start(names: string[]): void {
  const one = channel.peek();
  if (!one) return;
  const t = text.peek();
  const signals = liveSignals(one).filter(({ name }) => names.includes(name));
  const [length, part, threshold] = [typedNumber(seconds.peek()), typedNumber(before.peek()), typedNumber(level.peek())];
  if (signals.length === 0) return tell(t.chooseSignals, true);
  if (length === undefined || length <= 0 || length > 600) return tell(t.badDuration, true);
  if (part === undefined || part < 0 || part > 100) return tell(t.badBefore, true);
  if (threshold === undefined) return tell(`${t.level}: ${t.notANumber}`, true);
  const cycles = Math.round(length / (cyclePeriod.peek() ?? 0.001));
  const index = Math.max(0, signals.findIndex(({ name }) => name === triggerOf.peek()));
  const sampler = new Sampler(
    signals.map(({ name }) => name), signals.map(({ unit }) => unit), { signal: index, edge: edge.peek(), level: threshold }, cycles,
    edge.peek() === "none" ? 0 : Math.round((cycles * part) / 100),
  );
  running.value = sampler;
  // What the stream has now was before the key.
  const from = machine.peek().drive?.executed ?? -1;
  stopSampling = machine.subscribe((state) => {
    for (const { cycle, row } of rowsOf(signals, state, channel.peek())) if (cycle > from) sampler.push(cycle, row);
    progress.value = { state: sampler.state, rows: sampler.rows };
    if (sampler.state === "done") queueMicrotask(finish);
  });
}

export function Sampling({ tabs }: { tabs: ComponentChild }) {
  const one = channel.value;
  useEffect(() => {
    if (one && chosen.peek() === null) chosen.value = liveSignals(one).map(({ name }) => name).filter((name) => /^(actual|following)\.[XYZ]$/.test(name));
  }, [one === undefined]);
  if (!one) return null;
  const t = text.value;
  const offered = liveSignals(one);
  const names = chosen.value ?? [];
  const toggle = (name: string) => (chosen.value = names.includes(name) ? names.filter((other) => other !== name) : [...names, name]);
  const waits = running.value !== null;
  return (
    <>
      <section class="sampling-keys" aria-label={t.sampling}>
        {tabs}
        <details class="chooser">
          <summary>{t.signals(names.length)}</summary>
          <div class="scroll" tabIndex={0} role="group" aria-label={t.signalChoice}>
            {offered.map(({ name, unit, axis }) => (
              <button key={name} aria-pressed={names.includes(name)} disabled={!names.includes(name) && names.length >= mostSignals} onClick={() => toggle(name)}>
                {name} <span class="dim">{unit}{axis === undefined ? " · 20/s" : ""}</span>
              </button>
            ))}
          </div>
        </details>
        <label><span>{t.duration}</span><input aria-label={t.duration} class="short digits" inputMode="decimal" value={seconds.value} onInput={(event) => (seconds.value = event.currentTarget.value)} /></label>
        <label>
          <span>{t.trigger}</span>
          <select aria-label={t.trigger} value={edge.value} onChange={(event) => (edge.value = event.currentTarget.value as Trigger["edge"])}>
            <option value="none">{t.triggerNone}</option>
            <option value="rising">{t.triggerRising}</option>
            <option value="falling">{t.triggerFalling}</option>
          </select>
        </label>
        {edge.value !== "none" && (
          <>
            <label>
              <span>{t.triggerSignal}</span>
              <select aria-label={t.triggerSignal} value={triggerOf.value || names[0]} onChange={(event) => (triggerOf.value = event.currentTarget.value)}>
                {names.map((name) => <option key={name} value={name}>{name}</option>)}
              </select>
            </label>
            <label><span>{t.level}</span><input aria-label={t.level} class="short digits" inputMode="decimal" value={level.value} onInput={(event) => (level.value = event.currentTarget.value)} /></label>
            <label><span>{t.beforeTrigger}</span><input aria-label={t.beforeTrigger} class="short digits" inputMode="decimal" value={before.value} onInput={(event) => (before.value = event.currentTarget.value)} /></label>
          </>
        )}
        {waits ? <button onClick={finish}>{t.stopSampling}</button> : <button class="primary" onClick={() => start(names)}>{t.startSampling}</button>}
        <span role="status" class="dim" data-test="sampling">
          {waits ? (progress.value.state === "waiting" ? t.waitingForTrigger : t.samplingRows(progress.value.rows)) : ""}
        </span>
      </section>
      {sampled.value ? <RecordingView recording={sampled.value} letters={one.letters} /> : <section class="dim" aria-label={t.sampling}>{t.samplingAbout}</section>}
    </>
  );
}
