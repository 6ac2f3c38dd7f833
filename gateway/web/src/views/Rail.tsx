// SPDX-License-Identifier: Apache-2.0
// The views, and what the operator chooses for this browser.
import { type Language, language, theme, type Theme, themes } from "../state/preferences";
import { view, type ViewName } from "../state/store";
import { languages, text, type Texts } from "../text/texts";
import { WhoIsThere } from "./Login";
import { OperatingKey } from "./OperatingRight";

const views: [ViewName, keyof Texts & `view${string}`][] = [
  ["operate", "viewOperate"],
  ["scene", "viewScene"],
  ["programs", "viewPrograms"],
  ["setup", "viewSetup"],
  ["parameters", "viewParameters"],
  ["analysis", "viewAnalysis"],
  ["diagnosis", "viewDiagnosis"],
];

/** Alt and the number of the view, from 1. */
export const viewOfKey: Record<string, ViewName> = Object.fromEntries(views.map(([name], index) => [String(index + 1), name]));

const themeText: Record<Theme, keyof Texts & `theme${string}`> = { system: "themeSystem", dark: "themeDark", light: "themeLight" };

export function Rail() {
  const t = text.value;
  return (
    <nav aria-label={t.navigation}>
      {views.map(([name, title], index) => (
        <button
          key={name}
          aria-current={view.value === name ? "page" : undefined}
          title={`Alt+${index + 1}`}
          data-test={`view-${name}`}
          onClick={() => (view.value = name)}
        >
          {t[title] as string}
        </button>
      ))}
      <div class="choices">
        <OperatingKey />
        <WhoIsThere />
        <select
          aria-label={t.language}
          title={t.language}
          data-test="language"
          value={language.value}
          onChange={(event) => (language.value = event.currentTarget.value as Language)}
        >
          {Object.entries(languages).map(([name, texts]) => (
            <option key={name} value={name} lang={name}>{texts.languageName}</option>
          ))}
        </select>
        <select
          aria-label={t.theme}
          title={t.theme}
          data-test="theme"
          value={theme.value}
          onChange={(event) => (theme.value = event.currentTarget.value as Theme)}
        >
          {themes.map((one) => (
            <option key={one} value={one}>{t[themeText[one]] as string}</option>
          ))}
        </select>
      </div>
    </nav>
  );
}
