// SPDX-License-Identifier: Apache-2.0
// The right to operate: one station at a time, when the machine says so.
import { computed, signal } from "@preact/signals";
import { type Answer, get, post } from "../api";
import type { OperatingRight, OperatingStation } from "../contract";
import { machine } from "./store";

/** What the gateway says of this station; null before it has answered. */
const own = signal<OperatingRight | null>(null);

/** Also makes this browser a station: its answer brings the cookie. */
export async function askOperating(): Promise<void> {
  const answer = await get<OperatingRight>("/api/operating-right");
  if (answer.ok && answer.body) own.value = answer.body;
}

export type Action = "take" | "hand_over" | "refuse" | "release";
export async function changeOperating(action: Action): Promise<Answer<OperatingRight>> {
  const answer = (await post("/api/operating-right", { action })) as Answer<OperatingRight>;
  if (answer.ok && answer.body) own.value = answer.body;
  return answer;
}

export interface Operating {
  /** One station operates; otherwise every one does. */
  one: boolean;
  mine: boolean;
  mayTakeOver: boolean;
  holder: OperatingStation | null;
  asking: OperatingStation | null;
  /** This station asks. */
  asks: boolean;
}

export function operatingOf(state: { operating?: { holder?: OperatingStation; asking?: OperatingStation } }, station: OperatingRight | null): Operating {
  const { holder = null, asking = null } = state.operating ?? {};
  return {
    one: state.operating !== undefined,
    mine: holder !== null && holder.number === station?.number,
    mayTakeOver: station?.may_take_over ?? false,
    holder,
    asking,
    asks: asking !== null && asking.number === station?.number,
  };
}

export const operating = computed(() => operatingOf(machine.value, own.value));

/** Name of the other station that operates; empty when this one may give orders. */
export const otherStation = computed(() => (operating.value.one && operating.value.holder && !operating.value.mine ? operating.value.holder.name : ""));
