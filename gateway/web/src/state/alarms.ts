// SPDX-License-Identifier: Apache-2.0
// What an alarm says in the operator's language, why it usually comes and what the operator does, from the catalogue of
// alarms.
import { alarmCatalogue, languageAlarms } from "../alarm_catalogue";
import { alarmText } from "../plc/messages";
import type { Texts } from "../text/texts";
import type { Alarm } from "./model";

export interface Explanation {
  /** Empty where the text itself names it. */
  cause: string;
  remedy: string;
}

/** Undefined for a number that is not in the catalogue. */
export function explanation(alarm: Pick<Alarm, "number">, text: Texts): Explanation | undefined {
  const { first, last, remedy } = languageAlarms;
  if (alarm.number >= first && alarm.number <= last) return { cause: "", remedy: remedy[text.languageCode] ?? "" };
  return alarmCatalogue[alarm.number]?.[text.languageCode];
}

export interface Wording {
  text: string;
  /** What the service says besides it, with names and numbers, in English; empty when that is no more. */
  detail: string;
}

/** Messages of the machine's PLC and of a program: whoever wrote them chose the language. */
const messages: readonly number[] = [136, 137, 138, 151];

export function wording(alarm: Pick<Alarm, "number" | "part" | "text"> & { since?: string }, text: Texts): Wording {
  const own = alarmText(alarm);
  const one = alarmCatalogue[alarm.number];
  const translated = text.languageCode === "en" ? undefined : one?.[text.languageCode]?.text;
  if (!translated || messages.includes(alarm.number)) return { text: own, detail: "" };
  return { text: translated, detail: own === one?.en?.text ? "" : own };
}
