// SPDX-License-Identifier: Apache-2.0
// The machine's messages (alarms 136 to 138) in the language of the operator, from messages.yaml of the PLC's programs.
import { signal } from "@preact/signals";
import { type Language, language } from "../state/preferences";

const keys: Record<Exclude<Language, "en">, string> = { de: "german", zh: "chinese" };
const first = 136, last = 138;

/** Of one language, by the number of the message. */
export function translated(source: string, key: string): Map<number, string> {
  const found = new Map<number, string>();
  const text = new RegExp(`\\b${key}:[ \\t]*(?:"([^"\\n]*)"|'([^'\\n]*)'|([^,}\\n]+))`);
  for (const [, number, body] of source.matchAll(/^(\d+):((?:(?!\n\d)[\s\S])*)/gm)) {
    const words = text.exec(body!);
    if (words) found.set(Number(number), (words[1] ?? words[2] ?? words[3]!).trim());
  }
  return found;
}

const source = signal<string | undefined>(undefined);
let asked = "";

/** The text of an alarm; the service's own, in English, until the file is here and when it has no other. */
export function alarmText(alarm: { number: number; part: number; text: string; since?: string }): string {
  const chosen = language.value;
  if (alarm.number < first || alarm.number > last || chosen === "en") return alarm.text;
  // Other programs may run since the alarm before.
  const since = alarm.since ?? (asked || "past");
  if (asked !== since) {
    asked = since;
    void fetch("/api/plc/programs/messages.yaml").then(async (answer) => {
      if (answer.ok) source.value = await answer.text();
    }, () => undefined);
  }
  return translated(source.value ?? "", keys[chosen]).get(alarm.part) ?? alarm.text;
}
