// SPDX-License-Identifier: Apache-2.0
// The texts in the language that the operator has chosen. A language without one of the texts does not compile.
import { computed } from "@preact/signals";
import { language } from "../state/preferences";
import { chinese } from "./chinese";
import { english } from "./english";
import { german } from "./german";

type Table = typeof english;

/** The texts of one language: strings, and functions where a number or name is part of the text. */
export type Texts = {
  readonly [Key in keyof Table]: Table[Key] extends (...values: infer Values) => string ? (...values: Values) => string : string;
};

export const languages = { en: english, zh: chinese, de: german } satisfies Record<string, Texts>;
export type Language = keyof typeof languages;

export const text = computed<Texts>(() => languages[language.value]);
