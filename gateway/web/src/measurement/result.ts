// SPDX-License-Identifier: Apache-2.0
// A result of a measurement as rows and as points of a plot.
import type { MeasurementPose, MeasurementResult, MeasurementState, MeasurementVector } from "../contract";
import { fixed } from "../format";

const rotary = ["A", "B", "C", "U", "V", "W"];

/** mm as um with its sign: +1.2, −0.4, 0.0. */
export function micrometres(value: number): string {
  const text = fixed(value * 1000, 1);
  return Number(text.replace("\u2212", "-")) > 0 ? `+${text}` : text;
}

/** Rotary axes that a pose is named by: A, B and C of the channel, what a vector places, and what differs between the poses. */
export function lettersOf(result: MeasurementResult, ofChannel: string): string[] {
  const placed = new Set([..."ABC"].filter((letter) => ofChannel.includes(letter)).concat(result.vectors.map(({ axis }) => axis)));
  const first = result.poses[0];
  return rotary.filter((letter, i) => placed.has(letter) || result.poses.some((pose) => pose.angles[i] !== first?.angles[i]));
}

/** "A−60 C0" */
export function poseName(pose: MeasurementPose, letters: string[]): string {
  const angle = (letter: string) => fixed(pose.angles[rotary.indexOf(letter)] ?? 0, 3).replace(/\.?0+$/, "");
  return letters.map((letter) => `${letter}${angle(letter)}`).join(" ");
}

export interface VectorRow {
  axis: string;
  component: "X" | "Y" | "Z";
  /** mm */
  before: number;
  after: number;
  change: number;
  uncertainty: number;
}

export function vectorRows(vectors: MeasurementVector[]): VectorRow[] {
  return vectors.flatMap(({ axis, before, after, uncertainty }) =>
    (["X", "Y", "Z"] as const).map((component, i) => ({
      axis, component, before: before[i]!, after: after[i]!, change: after[i]! - before[i]!, uncertainty: uncertainty[i]!,
    })));
}

/** Angle between the ideal and the measured direction, urad. */
export function inclination({ direction_before: a, direction_after: b }: MeasurementVector): number {
  const cross = [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
  const dot = a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
  return Math.atan2(Math.hypot(...cross), dot) * 1e6;
}

export type Shown = "difference" | "residual";

/** The largest of X, Y and Z of all poses; nothing when no pose has a result. */
export function largest(poses: MeasurementPose[], what: Shown): { pose: MeasurementPose; component: number; value: number } | undefined {
  const all = poses.flatMap((pose) => pose[what].map((value, component) => ({ pose, component, value })));
  return all.reduce<(typeof all)[number] | undefined>((best, one) => (best && Math.abs(best.value) >= Math.abs(one.value) ? best : one), undefined);
}

/** Half the height of the plot, um: the next of 1, 2, 5, 10 ... above the largest value. */
export function plotRange(poses: MeasurementPose[], what: Shown): number {
  const top = Math.abs(largest(poses, what)?.value ?? 0) * 1000;
  const decade = 10 ** Math.floor(Math.log10(Math.max(top, 1)));
  return [1, 2, 5, 10].map((step) => step * decade).find((value) => value >= top)!;
}

/** Whether the result belongs to what the state says: it is published a moment later. */
export function isOf(state: MeasurementState, result: MeasurementResult | undefined): boolean {
  if (state.phase === "NOTHING") return true;
  if (result?.measurement !== state.measurement || result.poses.length < state.complete) return false;
  return result.valid || (state.phase !== "WAITING" && state.phase !== "FINISHED");
}
