// SPDX-License-Identifier: Apache-2.0
// What the selected program of the shown channel will do: asked for anew when the program changes, or what it depends on.
import { effect, signal } from "@preact/signals";
import { get } from "../api";
import type { ProgramPlan } from "../contract";
import { cyclePeriod } from "./cycle_period";
import { RemainingTime } from "./remaining_time";
import { channel, machine } from "./store";

/** Milliseconds after a change: several values are often changed one after the other. */
const pause = 500;
/** Milliseconds after an answer that others are planned, or that the cluster is not ready. */
const patience = 3000;

/** Undefined while there is none. */
export const plan = signal<ProgramPlan | undefined>(undefined);
/** Seconds of the plan that are left. */
export const remaining = signal<number | undefined>(undefined);

export function followPlan(): void {
  let asked = "";
  let timer: ReturnType<typeof setTimeout> | undefined;
  effect(() => {
    const one = channel.value;
    const { parameters, tools, work_offsets } = machine.value.revisions;
    const wanted = one?.program ? [one.channel, one.program, one.program_revision, parameters, tools, work_offsets].join() : "";
    if (wanted === asked) return;
    const other = wanted.split(",").slice(0, 2).join() !== asked.split(",").slice(0, 2).join();
    asked = wanted;
    if (other) plan.value = undefined;
    clearTimeout(timer);
    if (!one?.program) return;
    const [number, program] = [one.channel, one.program];
    const ask = async () => {
      const answer = await get<ProgramPlan>(`/api/programs/${encodeURIComponent(program)}/plan?channel=${number}`);
      if (asked !== wanted) return;
      plan.value = answer.ok ? answer.body : undefined;
      if (answer.status >= 500) timer = setTimeout(() => void ask(), patience);
    };
    timer = setTimeout(() => void ask(), pause);
  });

  let time: RemainingTime | undefined;
  effect(() => {
    const now = plan.value;
    time = now && new RemainingTime(now);
    if (!now) remaining.value = undefined;
  });
  effect(() => {
    const [one, tick, period] = [channel.value, machine.value.drive?.tick, cyclePeriod.value];
    if (!plan.value || !time || !one || tick === undefined || period === undefined) return;
    time.observe(one, tick * period);
    remaining.value = time.seconds;
  });
}
