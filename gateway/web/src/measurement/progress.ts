// SPDX-License-Identifier: Apache-2.0
// What a measurement is doing, and what may be asked of it. The service decides the same again.
import type { MeasurementPhase, MeasurementState } from "../contract";
import type { Texts } from "../text/texts";

export function phaseText(phase: MeasurementPhase, t: Texts): string {
  const texts: Record<MeasurementPhase, string> = {
    NOTHING: t.phaseNothing, PLANNING: t.phasePlanning, REPEATABILITY: t.phaseRepeatability, MEASURING: t.phaseMeasuring,
    RETRACTING: t.phaseRetracting, ESTIMATING: t.phaseEstimating, WAITING: t.phaseWaiting, WRITING: t.phaseWriting,
    STOPPING: t.phaseStopping, INTERRUPTED: t.phaseInterrupted, FINISHED: t.phaseFinished,
  };
  return texts[phase];
}

const underWay = new Set<MeasurementPhase>(["PLANNING", "REPEATABILITY", "MEASURING", "RETRACTING", "ESTIMATING", "WRITING", "STOPPING"]);

export const isUnderWay = (phase: MeasurementPhase) => underWay.has(phase);

export interface Possible {
  start: boolean;
  abort: boolean;
  continue: boolean;
  confirm: boolean;
  discard: boolean;
}

export function possibleOrders(state: MeasurementState): Possible {
  const busy = isUnderWay(state.phase);
  return {
    start: !busy,
    abort: busy && state.phase !== "WRITING" && state.phase !== "STOPPING",
    continue: state.may_continue,
    confirm: state.may_confirm,
    discard: !busy && state.phase !== "NOTHING",
  };
}

/** Poses or a result that nobody has written are lost by a new start. */
export const givesUp = ({ phase }: MeasurementState) => phase === "WAITING" || phase === "INTERRUPTED";

/** The pose under way, counted from 1: "3 of 16"; all of them when they are complete. */
export const poseNumber = (state: MeasurementState) => Math.min(state.complete + 1, state.poses);
