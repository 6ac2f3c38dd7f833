// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get, type PlcImage } from "../api";
import { compact, duration } from "../format";
import { sortedServices } from "../state/model";
import { machine } from "../state/store";
import { Alarms } from "./Alarms";
import { Plots } from "./Plots";

function Services() {
  const rows = sortedServices(machine.value);
  return (
    <section class="services" aria-label="services">
      <div class="title">
        <h2>Services</h2>
        <span class="dim">{rows.filter((row) => row.alive).length} of {rows.length} alive</span>
      </div>
      <div class="scroll">
        <table>
          <thead>
            <tr>
              <th>Service</th><th>Copy</th><th>Vendor</th><th>PID</th><th>State</th><th>Detail</th>
              <th class="right">Frames/s</th><th class="right">Lost</th><th class="right">Restarts</th>
              <th class="right">Up</th><th>Heartbeat</th>
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
                <td class="detail">{row.contract_match ? row.detail : `built with another contract (${row.contract})`}</td>
                <td class="right digits">{compact(row.frames_per_second)}</td>
                <td class="right digits">{row.frames_lost}</td>
                <td class="right digits">{row.restarts}</td>
                <td class="right digits">{duration(row.uptime)}</td>
                <td><span class={`dot ${row.alive ? "good" : "bad"}`} /> {row.alive ? "alive" : "silent"}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

const areas = ["x", "y", "f", "g", "r", "b"] as const;
const wordsPerPage = 64;

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
  const bits = area.value === "x" || area.value === "y" || area.value === "r";
  return (
    <section class="plc" aria-label="PLC registers">
      <div class="title">
        <h2>PLC</h2>
        <div class="segments small">
          {areas.map((name) => (
            <button key={name} aria-pressed={area.value === name} onClick={() => { area.value = name; start.value = 0; }}>
              {name.toUpperCase()}
            </button>
          ))}
        </div>
        <div class="end">
          <button aria-label="earlier registers" disabled={start.value === 0} onClick={() => (start.value -= wordsPerPage)}>‹</button>
          <span class="dim digits">{start.value}…{Math.min(values.length, start.value + wordsPerPage) - 1}</span>
          <button aria-label="later registers" disabled={start.value + wordsPerPage >= values.length} onClick={() => (start.value += wordsPerPage)}>›</button>
        </div>
      </div>
      {values.length === 0 ? (
        <p class="dim">{missing.value || "waiting for the first image"}</p>
      ) : (
        <div class="registers digits">
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
  return (
    <main class="diagnosis">
      <Services />
      <section class="side" aria-label="plots">
        <div class="title">
          <h2>Last 30 s</h2>
          {drive && <span class="dim digits">cycle {drive.executed} · starved {drive.starved}</span>}
        </div>
        <Plots />
      </section>
      <Plc />
      <Alarms />
    </main>
  );
}
