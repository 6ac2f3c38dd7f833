// SPDX-License-Identifier: Apache-2.0
// What the operator has chosen for this browser: language and colours. Kept over reloads where the browser permits it.
import { computed, effect, signal } from "@preact/signals";

export type Theme = "system" | "dark" | "light";
export const themes: readonly Theme[] = ["system", "dark", "light"];
const known = ["en", "zh", "de"] as const;
export type Language = (typeof known)[number];

/** What is stored under a name, or null: a browser may refuse to keep anything. */
export function kept(name: string): string | null {
  try {
    return localStorage.getItem(`trunnion.${name}`);
  } catch {
    return null;
  }
}

export function keep(name: string, value: string): void {
  try {
    localStorage.setItem(`trunnion.${name}`, value);
  } catch {
    // Private windows and full storage: the choice lasts as long as the page.
  }
}

/** The first of the browser's languages that the page has; English when none is. */
export function languageOf(stored: string | null, preferred: readonly string[]): Language {
  const wanted = [...(stored ? [stored] : []), ...preferred].map((one) => one.slice(0, 2).toLowerCase());
  return wanted.find((one): one is Language => known.some((language) => language === one)) ?? "en";
}

export function themeOf(stored: string | null): Theme {
  return themes.find((theme) => theme === stored) ?? "system";
}

const inBrowser = typeof window !== "undefined";
export const language = signal<Language>(languageOf(kept("language"), inBrowser ? navigator.languages : []));
export const theme = signal<Theme>(themeOf(kept("theme")));
const systemLight = signal(false);

/** What is drawn: canvases read their colours anew when it changes. */
export const shownTheme = computed(() => (theme.value === "system" ? (systemLight.value ? "light" : "dark") : theme.value));

/** Applies the choices to the document, and keeps them, for as long as the page lives. */
export function applyPreferences(): void {
  const media = window.matchMedia("(prefers-color-scheme: light)");
  systemLight.value = media.matches;
  media.addEventListener("change", () => (systemLight.value = media.matches));
  effect(() => {
    document.documentElement.lang = language.value;
    keep("language", language.value);
  });
  effect(() => {
    document.documentElement.dataset.theme = shownTheme.value;
    keep("theme", theme.value);
  });
}

/** A colour of style.css in the theme that is shown. */
export function colour(name: string): string {
  void shownTheme.value;
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
