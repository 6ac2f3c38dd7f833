// SPDX-License-Identifier: Apache-2.0
// The texts in the language that the operator has chosen. A language without one of the texts does not compile.
import { computed } from "@preact/signals";
import { type Language, language } from "../state/preferences";
import { chinese } from "./chinese";
import { english } from "./english";
import { german } from "./german";
import type { Translation } from "./translation";

/** The texts of one language. */
export type Texts = Translation<typeof english>;

export const languages = { en: english, zh: chinese, de: german } satisfies Record<Language, Texts>;

export const text = computed<Texts>(() => languages[language.value]);
