// SPDX-License-Identifier: Apache-2.0
// The time of one interpolation cycle, parameter 000001, which turns counted cycles into seconds.
import { effect, signal } from "@preact/signals";
import { get } from "../api";
import type { Parameter } from "../contract";
import { machine } from "./store";

/** Seconds; undefined until it has been read. */
export const cyclePeriod = signal<number | undefined>(undefined);

export function readCyclePeriod(): void {
  let read: number | undefined;
  effect(() => {
    const revision = machine.value.revisions.parameters;
    if (revision === undefined || revision === read) return;
    read = revision;
    void get<Parameter>("/api/parameters/1").then((answer) => {
      if (answer.ok && answer.body) cyclePeriod.value = Number(answer.body.value) / 1e6;
    });
  });
}
