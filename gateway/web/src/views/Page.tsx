// SPDX-License-Identifier: Apache-2.0
import { useEffect } from "preact/hooks";
import { channel, channelList, command, connection, machine, notice, stop, view, type ViewName } from "../state/store";
import { Alarms } from "./Alarms";
import { Attention } from "./Attention";
import { Controls } from "./Controls";
import { Diagnosis } from "./Diagnosis";
import { Header } from "./Header";
import { Jog } from "./Jog";
import { Offsets } from "./Offsets";
import { Parameters } from "./Parameters";
import { Positions } from "./Positions";
import { ProgramPanel } from "./ProgramPanel";
import { SidePanel } from "./SidePanel";
import { Technology } from "./Technology";

const viewOfKey: Record<string, ViewName> = { "1": "operate", "2": "parameters", "3": "offsets", "4": "diagnosis" };

function Operate() {
  if (!channel.value) {
    return (
      <main class="empty">
        <p>No channel has reported yet.</p>
        <p class="dim">
          {machine.value.cluster ? "The cluster is starting; see Diagnosis (Alt+4)." : "No cluster is announced."}
        </p>
      </main>
    );
  }
  return (
    <main class="operate">
      <div class="column">
        <Positions />
        <Technology />
      </div>
      <ProgramPanel />
      <div class="column">
        <SidePanel />
        <Alarms />
      </div>
      <Controls />
      <Jog />
    </main>
  );
}

function Notice() {
  const value = notice.value;
  return (
    <div class="notice-place" role="status" aria-live="polite">
      {value && (
        <div class={`notice ${value.refused ? "refused" : ""}`} onClick={() => (notice.value = null)}>
          {value.text}
        </div>
      )}
    </div>
  );
}

function ConnectionLost() {
  if (connection.value === "live") return null;
  const lost = connection.value === "lost";
  return (
    <div class="lost" role="alertdialog" aria-label="connection">
      <div>
        <h1>{lost ? "Connection lost" : "Connecting…"}</h1>
        <p>
          {lost
            ? "What is behind this is old. The machine may be moving: use the hard-wired emergency stop."
            : "Waiting for the gateway."}
        </p>
        {lost && <p class="dim">Trying to reconnect…</p>}
      </div>
    </div>
  );
}

/** There Escape empties the field. */
const isSearch = (target: EventTarget | null) => target instanceof HTMLInputElement && target.type === "search";

export function Page() {
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.altKey && viewOfKey[event.key]) {
        view.value = viewOfKey[event.key]!;
        event.preventDefault();
      } else if (event.key === "Escape" && !isSearch(event.target)) {
        // Whoever presses it in haste means the machine, not the channel that is shown.
        for (const number of channelList.value) void stop("Feed hold", `/api/channels/${number}/feed-hold`);
      } else if (event.key === "Enter" && event.ctrlKey && view.value === "operate") {
        void command("Cycle start", "cycle-start", {});
        event.preventDefault();
      }
    };
    window.addEventListener("keydown", onKey);
    return () => window.removeEventListener("keydown", onKey);
  }, []);
  return (
    <div class={`page ${machine.value.plc?.emergency_stop ? "stopped" : ""}`}>
      <Header />
      <Attention />
      {view.value === "operate" && <Operate />}
      {view.value === "parameters" && <Parameters />}
      {view.value === "offsets" && <Offsets />}
      {view.value === "diagnosis" && <Diagnosis />}
      <Notice />
      <ConnectionLost />
    </div>
  );
}
