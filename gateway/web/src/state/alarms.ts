// SPDX-License-Identifier: Apache-2.0
// Why an alarm usually comes and what the operator does, from the catalogue of alarms.
import { alarmCatalogue } from "../alarm_catalogue";
import type { Texts } from "../text/texts";
import type { Alarm } from "./model";

export interface Explanation {
  /** Empty where the text itself names it. */
  cause: string;
  remedy: string;
}

/** Undefined for a number that is not in the catalogue. Alarms of the NC language (1000 .. 1999) name place and cause. */
export function explanation(alarm: Pick<Alarm, "number">, text: Texts): Explanation | undefined {
  if (alarm.number >= 1000 && alarm.number < 2000) return { cause: "", remedy: text.languageRemedy };
  return alarmCatalogue[alarm.number]?.[text.languageCode];
}
