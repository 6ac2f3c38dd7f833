// SPDX-License-Identifier: Apache-2.0
// Values of the watched variables after each scan of the PLC, plotted.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get, post, remove } from "../api";
import type { PlcTraceRows } from "../contract";
import { typedNumber } from "../format";
import { plotted } from "../plc/watch";
import { tell } from "../state/store";
import { text } from "../text/texts";
import { type Lane, Waveforms } from "./Waveforms";

const period = 200;  // ms between two questions

export function PlcTrace({ paths }: { paths: readonly string[] }) {
  const t = text.value;
  const scans = useSignal("1000");
  const running = useSignal(false);
  const shown = useSignal<PlcTraceRows | null>(null);
  useEffect(() => {
    if (!running.value) return;
    let ended = false;
    let timer: ReturnType<typeof setTimeout>;
    const read = async () => {
      const answer = await get<PlcTraceRows>(`/api/plc/trace?from=${shown.peek()?.rows.length ?? 0}`);
      if (ended) return;
      if (!answer.body?.rows) {
        tell(answer.reason, true);
        running.value = false;
        return;
      }
      const before = shown.peek()?.rows ?? [];
      shown.value = { ...answer.body, rows: [...before, ...answer.body.rows] };
      if (answer.body.complete && answer.body.rows.length === 0) {
        running.value = false;
        void remove("/api/plc/trace");
        return;
      }
      timer = setTimeout(() => void read(), answer.body.rows.length > 0 ? 0 : period);
    };
    void read();
    return () => {
      ended = true;
      clearTimeout(timer);
    };
  }, [running.value]);
  const start = async () => {
    const answer = await post("/api/plc/trace", { paths, scans: typedNumber(scans.value) ?? 0 });
    if (!answer.ok) return tell(answer.reason, true);
    shown.value = null;
    running.value = true;
  };
  const rows = shown.value?.rows ?? [];
  const time = Float64Array.from(rows, ({ time_ms }) => time_ms - (rows[0]?.time_ms ?? 0));
  const lanes: Lane[] = (shown.value?.variables ?? []).map(({ path, unit }, index) => ({
    name: path, unit: unit ?? "", x: time, y: Float64Array.from(rows, ({ values }) => plotted(values[index] ?? "")),
  }));
  return (
    <div class="plc-trace">
      <form
        class="title"
        onSubmit={(event) => {
          event.preventDefault();
          void start();
        }}
      >
        <label class="row"><span class="dim">{t.plcScans}</span> <input class="short digits" inputMode="numeric" value={scans.value} onInput={(event) => (scans.value = event.currentTarget.value)} /></label>
        <button type="submit" disabled={paths.length === 0 || running.value}>{t.plcTraceStart}</button>
        <span class="dim end" role="status" data-test="plc-trace">{shown.value && t.plcTraceRows(rows.length, Number(scans.value))}</span>
      </form>
      {rows.length > 0 ? (
        <Waveforms label={t.plcTrace} test="plc-waveforms" lanes={lanes} from={0} to={time[time.length - 1] ?? 1} marks={[]} unit="ms" />
      ) : (
        <p class="dim">{t.plcTraceAbout}</p>
      )}
    </div>
  );
}
