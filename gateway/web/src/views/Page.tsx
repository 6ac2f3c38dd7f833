// SPDX-License-Identifier: Apache-2.0
import { useEffect } from "preact/hooks";
import { askOperating } from "../state/operating";
import { channel, command, connection, holdAll, machine, view } from "../state/store";
import { askSession, mustLogIn, session } from "../state/session";
import { text } from "../text/texts";
import { Attention } from "./Attention";
import { Controls } from "./Controls";
import { Diagnosis } from "./Diagnosis";
import { Guard } from "./Guard";
import { Header } from "./Header";
import { Jog } from "./Jog";
import { Later } from "./Later";
import { Login } from "./Login";
import { Mdi } from "./Mdi";
import { OperatingQuestion } from "./OperatingRight";
import { Positions } from "./Positions";
import { ProgramPanel } from "./ProgramPanel";
import { Question } from "./Question";
import { Rail, viewOfKey } from "./Rail";
import { SceneView } from "./SceneView";
import { SidePanel } from "./SidePanel";
import { Technology } from "./Technology";

function Operate() {
  const t = text.value;
  if (!channel.value) {
    return (
      <main class="empty">
        <p>{t.noChannel}</p>
        <p class="dim">{machine.value.cluster ? t.clusterStarting : t.noClusterAnnounced}</p>
      </main>
    );
  }
  return (
    <main class="operate">
      <div class="column">
        <Positions />
        <Technology />
      </div>
      <div class="column">
        <ProgramPanel />
        <Guard needs="operator"><Mdi /></Guard>
      </div>
      <SidePanel />
      <div class="panel">
        <Controls />
        <Guard needs="operator"><Jog /></Guard>
      </div>
    </main>
  );
}

/** Over what is old, but not over the keys that stop. */
function ConnectionLost() {
  if (connection.value === "live") return null;
  const t = text.value;
  const lost = connection.value === "lost";
  return (
    <div class="lost" role="alertdialog" aria-label={t.connection}>
      <div>
        <h1>{lost ? t.connectionLost : t.connecting}</h1>
        <p>{lost ? t.lostAdvice : t.waitingForGateway}</p>
        {lost && <p>{t.reconnecting}</p>}
      </div>
    </div>
  );
}

const loadPrograms = () => import("./Programs").then(({ Programs }) => Programs);
const loadSetup = () => import("./Setup").then(({ Setup }) => Setup);
const loadParameters = () => import("./Parameters").then(({ Parameters }) => Parameters);
const loadAnalysis = () => import("./Analysis").then(({ Analysis }) => Analysis);

/** There Escape empties the field, or closes the editor's search. */
const isSearch = (target: EventTarget | null) =>
  target instanceof HTMLInputElement && (target.type === "search" || target.closest(".cm-panel") !== null);
const isText = (target: EventTarget | null) => target instanceof HTMLTextAreaElement;

export function Page() {
  const live = connection.value === "live";
  useEffect(() => {
    if (live && session.peek()) return;
    void askSession();
    const timer = setInterval(() => void askSession(), 2000);
    return () => clearInterval(timer);
  }, [live]);
  const name = session.value?.name;
  useEffect(() => {
    if (live) void askOperating();
  }, [live, name]);
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.altKey && viewOfKey[event.key]) {
        view.value = viewOfKey[event.key]!;
        event.preventDefault();
      } else if (event.key === "Escape" && !isSearch(event.target)) {
        holdAll();
      } else if (event.key === "Enter" && event.ctrlKey && view.value === "operate" && !isText(event.target)) {
        void command(text.peek().cycleStart, "cycle-start", {});
        event.preventDefault();
      }
    };
    window.addEventListener("keydown", onKey);
    return () => window.removeEventListener("keydown", onKey);
  }, []);
  return (
    <div class={`page ${machine.value.plc?.emergency_stop ? "stopped" : ""} ${live ? "" : "old"}`}>
      <Header />
      <Attention />
      <Rail />
      {view.value === "operate" && <Operate />}
      {view.value === "scene" && <SceneView />}
      {view.value === "programs" && <Later load={loadPrograms} />}
      {view.value === "setup" && <Later load={loadSetup} />}
      {view.value === "parameters" && <Later load={loadParameters} />}
      {view.value === "analysis" && <Later load={loadAnalysis} />}
      {view.value === "diagnosis" && <Diagnosis />}
      <Question />
      <OperatingQuestion />
      {mustLogIn() ? <Login /> : <ConnectionLost />}
    </div>
  );
}
