// SPDX-License-Identifier: Apache-2.0
// The measurement of the kinematics with probe and sphere: its progress, what may be asked of it, inputs and result.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get, post } from "../api";
import type { Calibration, Measurement, MeasurementResult, MeasurementState } from "../contract";
import { refusal, timeOfDay } from "../format";
import { isUnderWay, phaseText, poseNumber, possibleOrders } from "../measurement/progress";
import { isOf, micrometres } from "../measurement/result";
import { machine, request, tell } from "../state/store";
import { text } from "../text/texts";
import { lacking, Note } from "./Guard";
import { MeasurementForm, StartKey } from "./MeasurementForm";
import { MeasurementReport } from "./MeasurementReport";
import { ask } from "./Question";
import { onPress } from "./press";

const result = signal<MeasurementResult | undefined>(undefined);
/** The calibration that can be undone, or why there is none. */
const last = signal<{ calibration?: Calibration; reason: string }>({ reason: "" });

const again = 300;  // ms until a result that is not published yet is asked for again

/** Keeps the result that belongs to the state, until the function it returns is called. */
function follow(state: MeasurementState): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let ended = false;
  const look = async () => {
    const answer = await get<Measurement>("/api/measurement");
    if (ended) return;
    if (answer.body?.state) result.value = state.phase === "NOTHING" ? undefined : answer.body.result;
    if (!isOf(state, result.value)) timer = setTimeout(() => void look(), again);
  };
  void look();
  return () => {
    ended = true;
    clearTimeout(timer);
  };
}

async function lookAtLast(): Promise<void> {
  const answer = await get<Calibration>("/api/measurement/undo");
  last.value = answer.ok ? { calibration: answer.body!, reason: "" } : { reason: answer.reason };
}

const when = (iso: string) => `${iso.slice(0, 10)} ${timeOfDay(iso)}`;

function UndoCalibration({ busy }: { busy: boolean }) {
  const t = text.value;
  const { calibration, reason } = last.value;
  const args = calibration && ([calibration.who, when(calibration.time), calibration.changes.length] as const);
  return (
    <button
      class="end"
      disabled={!calibration || busy || lacking("builder") !== ""}
      title={args ? t.undoCalibrationAbout(...args) : reason}
      onClick={() =>
        args && ask(t.undoCalibrationQuestion(...args), t.undoCalibration, () => {
          void post("/api/measurement/undo").then((answer) => {
            tell(answer.ok ? t.calibrationUndone(args[2]) : refusal(t.undoCalibration, answer.reason), !answer.ok);
            void lookAtLast();
          });
        })}
    >
      {t.undoCalibration}
    </button>
  );
}

function Orders({ state }: { state: MeasurementState }) {
  const t = text.value;
  const may = possibleOrders(state);
  const noSetter = lacking("setter") !== "";
  const send = (what: string, order: string, body = {}) => void request(what, `/api/measurement/${order}`, body);
  const confirm = () => {
    if (state.tolerance_alarm === "") return send(t.measurementConfirm, "confirm");
    ask(t.confirmQuestion(state.tolerance_alarm), t.confirmInSpite, () => send(t.measurementConfirm, "confirm", { acknowledge: true }));
  };
  return (
    <div class="row">
      <StartKey state={state} />
      <button class="abort" disabled={!may.abort} {...onPress(() => send(t.measurementAbort, "abort"))}>{t.measurementAbort}</button>
      <button disabled={!may.continue || noSetter} onClick={() => send(t.measurementContinue, "continue")}>{t.measurementContinue}</button>
      <button class={may.confirm ? "primary" : ""} disabled={!may.confirm || lacking("builder") !== ""} onClick={confirm}>{t.measurementConfirm}</button>
      <button disabled={!may.discard || noSetter} onClick={() => ask(t.discardMeasurement, t.measurementDiscard, () => send(t.measurementDiscard, "discard"))}>
        {t.measurementDiscard}
      </button>
      {may.confirm && !noSetter && <Note why={lacking("builder")} />}
      <UndoCalibration busy={isUnderWay(state.phase)} />
    </div>
  );
}

function Progress({ state }: { state: MeasurementState }) {
  const t = text.value;
  const busy = isUnderWay(state.phase);
  const percent = Math.round(100 * (state.phase === "FINISHED" || state.phase === "WAITING" ? 1 : state.progress));
  const poses = state.poses === 0 ? ""
    : state.phase === "MEASURING" || state.phase === "PLANNING" ? t.poseOf(poseNumber(state), state.poses, state.pose)
    : t.posesComplete(state.complete, state.poses);
  return (
    <>
      <div class="title">
        <h2>{t.measurementState}</h2>
        <b class="phase" role="status" data-test="measurement-phase" data-phase={state.phase}>{phaseText(state.phase, t)}</b>
        <span class="digits">{poses}</span>
        {state.measurement > 0 && state.phase !== "NOTHING" && (
          <span class="dim end">
            {state.repeatability >= 0 && <span>{t.repeatability} {micrometres(state.repeatability).replace("+", "")} um</span>}
            <span>{t.measurementOf(state.measurement, state.who || "–", when(state.time))}</span>
          </span>
        )}
      </div>
      {state.phase !== "NOTHING" && (
        <div class="meter" role="progressbar" aria-label={t.measurementProgress} aria-valuemin={0} aria-valuemax={100} aria-valuenow={percent} aria-valuetext={`${phaseText(state.phase, t)}, ${poses}`}>
          <i style={{ width: `${percent}%` }} />
        </div>
      )}
      {busy && state.detail !== "" && <p class="dim">{state.detail}</p>}
      {state.phase === "INTERRUPTED" && <p class="refusal">{state.error}</p>}
      {state.tolerance_alarm !== "" && (
        <p class="refusal">{state.tolerance_alarm}{state.tolerance_needs_reset && `: ${t.needsReset}`}</p>
      )}
      {state.phase === "FINISHED" && <p>{state.written ? t.writtenAndWaits : t.nothingWritten}</p>}
    </>
  );
}

export function Kinematics() {
  const state = machine.value.measurement;
  const { parameters, pending } = machine.value.revisions;
  const t = text.value;
  useEffect(() => (state ? follow(state) : undefined), [state?.measurement, state?.complete, state?.phase]);
  useEffect(() => void lookAtLast(), [parameters, pending, state?.written]);
  if (!state) return <section class="measurement"><p role="status">{t.noMeasurementService}</p></section>;
  return (
    <>
      <section class="measurement" aria-label={t.measurementState}>
        <Progress state={state} />
        <Orders state={state} />
      </section>
      <MeasurementForm />
      <MeasurementReport result={result.value} channelOf={state.channel} />
    </>
  );
}
