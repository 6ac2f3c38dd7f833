// SPDX-License-Identifier: Apache-2.0
import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get, type PlcImage } from "../api";
import { compact, duration } from "../format";
import { sortedServices } from "../state/model";
import { historySeconds } from "../state/history";
import { machine } from "../state/store";
import { text } from "../text/texts";
import { Alarms } from "./Alarms";
import { Later } from "./Later";
import { Plots } from "./Plots";

function Services() {
  const rows = sortedServices(machine.value);
  const t = text.value;
  return (
    <section class="services" aria-label={t.services}>
      <div class="title">
        <h2>{t.services}</h2>
        <span class="dim">{t.aliveOf(rows.filter((row) => row.alive).length, rows.length)}</span>
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.services}>
        <table>
          <thead>
            <tr>
              <th>{t.service}</th><th>{t.replica}</th><th>{t.vendor}</th><th>PID</th><th>{t.state}</th><th>{t.detail}</th>
              <th class="right">{t.batchesPerSecond}</th><th class="right">{t.lost}</th><th class="right">{t.restarts}</th>
              <th class="right">{t.up}</th><th>{t.heartbeat}</th>
            </tr>
          </thead>
          <tbody>
            {rows.map((row) => (
              <tr key={row.instance} class={row.alive ? "" : "dead"}>
                <td><b>{row.service}</b> <span class="dim">#{row.instance}</span></td>
                <td class="digits">{row.replica}</td>
                <td>{row.vendor}</td>
                <td class="digits">{row.pid || "–"}</td>
                <td><span class={`tag ${row.lifecycle === "ACTIVE" ? "good" : row.lifecycle === "FAULT" || row.lifecycle === "ABSENT" ? "bad" : "warn"}`}>{row.lifecycle.toLowerCase()}</span></td>
                <td class="detail">{row.contract_match ? row.detail : t.otherContract(row.contract)}</td>
                <td class="right digits">{compact(row.messages_per_second)}</td>
                <td class="right digits">{row.cycles_lost}</td>
                <td class="right digits">{row.restarts}</td>
                <td class="right digits">{duration(row.uptime)}</td>
                <td><span class={`dot ${row.alive ? "good" : "bad"}`} /> {row.alive ? t.alive : t.silent}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

const areas = ["x", "y", "f", "g", "r", "b", "w", "d", "t", "c", "k", "p"] as const;
const wordsPerPage = 64;

// First register of the page that shows this one.
function pageOf(register: number, count: number): number {
  const wanted = Math.min(Math.max(0, Math.floor(register) || 0), Math.max(0, count - 1));
  return wanted - (wanted % wordsPerPage);
}

const showsPrograms = signal(false);
const loadPlc = () =>
  import("./PlcView").then(({ PlcView }) => () => <PlcView close={() => (showsPrograms.value = false)} />);

function Plc() {
  const area = useSignal<(typeof areas)[number]>("x");
  const start = useSignal(0);
  const image = useSignal<PlcImage | null>(null);
  const missing = useSignal("");
  useEffect(() => {
    let alive = true;
    let timer: ReturnType<typeof setTimeout>;
    const poll = async () => {
      const answer = await get<PlcImage>("/api/plc/image");
      if (!alive) return;
      if (answer.ok && answer.body) image.value = answer.body;
      missing.value = answer.ok ? "" : answer.reason;
      timer = setTimeout(() => void poll(), 300);
    };
    void poll();
    return () => {
      alive = false;
      clearTimeout(timer);
    };
  }, []);
  const values = image.value?.[area.value] ?? [];
  const bits = area.value === "x" || area.value === "y" || area.value === "r" || area.value === "k";
  const t = text.value;
  return (
    <section class="plc" aria-label={t.plcRegisters}>
      <div class="title">
        <h2>{t.plc}</h2>
        <button onClick={() => (showsPrograms.value = true)}>{t.plcPrograms}</button>
        <div class="segments" role="group" aria-label={t.plcArea}>
          {areas.map((name) => (
            <button key={name} aria-pressed={area.value === name} onClick={() => { area.value = name; start.value = 0; }}>
              {name.toUpperCase()}
            </button>
          ))}
        </div>
        <div class="end">
          <input type="number" class="digits" aria-label={t.showRegister} min={0} max={Math.max(0, values.length - 1)} value={start.value}
            onChange={(event) => { start.value = pageOf(event.currentTarget.valueAsNumber, values.length); }} />
          <button aria-label={t.earlierRegisters} disabled={start.value === 0} onClick={() => (start.value -= wordsPerPage)}>‹</button>
          <span class="dim digits">{start.value}…{Math.min(values.length, start.value + wordsPerPage) - 1}</span>
          <button aria-label={t.laterRegisters} disabled={start.value + wordsPerPage >= values.length} onClick={() => (start.value += wordsPerPage)}>›</button>
        </div>
      </div>
      {values.length === 0 ? (
        <p class="dim">{missing.value || t.waitingForImage}</p>
      ) : (
        <div class="registers digits" tabIndex={0} role="region" aria-label={t.plcRegisters}>
          {values.slice(start.value, start.value + wordsPerPage).map((value, index) => (
            <span key={index} class={value ? "set" : ""}>
              <i>{area.value.toUpperCase()}{start.value + index}</i>
              {bits ? value.toString(2).padStart(8, "0") : value}
            </span>
          ))}
        </div>
      )}
    </section>
  );
}

export function Diagnosis() {
  const drive = machine.value.drive;
  const t = text.value;
  if (showsPrograms.value) return <Later load={loadPlc} />;
  return (
    <main class="diagnosis">
      <Services />
      <section class="side" aria-label={t.plots}>
        <div class="title">
          <h2>{t.lastSeconds(historySeconds)}</h2>
          {drive && <span class="dim digits">{t.cycleAndStarved(drive.executed, drive.starved)}</span>}
        </div>
        <Plots />
      </section>
      <Plc />
      <Alarms />
    </main>
  );
}
