// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { alarmCatalogue, languageAlarms } from "../src/alarm_catalogue";
import { explanation, wording } from "../src/state/alarms";
import { languageOf, themeOf } from "../src/state/preferences";
import { languages } from "../src/text/texts";

// The compiler checks that every key is present; a text that was not translated has the English words.
const same = new Set([
  "viewScene", "modeAUTO", "modeMDI", "modeJOG", "modeREF", "modeAuto", "modeMdi", "mdi", "plc", "classNc", "reset", "name",
  "virtualTime", "detail", "radius", "viewParameters", "parameters", "parameter", "programmed", "sceneSpeed", "valueIn", "axisUnit", "setup",
  "plcTask", "lifeMinutes",
]);

test("every text is translated and none is empty", () => {
  const values = { number: 7, name: "X" };
  const shown = (text: unknown) => (typeof text === "function" ? String(text(values.number, values.name, 3)) : String(text));
  const untranslated: string[] = [];
  for (const language of ["zh", "de"] as const) {
    for (const [key, text] of Object.entries(languages[language])) {
      const english = languages.en[key as keyof typeof languages.en];
      expect(shown(text).trim(), `${language}.${key}`).not.toBe("");
      if (!same.has(key) && shown(text) === shown(english)) untranslated.push(`${language}.${key}`);
    }
  }
  expect(untranslated).toEqual([]);
});

test("the browser's language is used where the page has it, else English", () => {
  expect(languageOf(null, ["fr-FR", "de-AT", "en"])).toBe("de");
  expect(languageOf(null, ["zh-Hans-CN"])).toBe("zh");
  expect(languageOf("zh", ["de"])).toBe("zh");
  expect(languageOf("xx", [])).toBe("en");
  expect(themeOf("light")).toBe("light");
  expect(themeOf("pink")).toBe("system");
});

test("every machine alarm has cause and remedy; alarms of the language name theirs in the text", () => {
  for (const [number, languagesOfOne] of Object.entries(alarmCatalogue)) {
    expect(Object.keys(languagesOfOne), number).toEqual(Object.keys(languages));
    const shown = Object.values(languages).map((texts) => explanation({ number: Number(number) }, texts)!);
    expect(new Set(Object.values(languagesOfOne).map((one) => one.text)).size, `${number}: text`).toBe(3);
    expect(new Set(shown.map((one) => one.cause)).size, `${number}: cause`).toBe(3);
    expect(new Set(shown.map((one) => one.remedy)).size, `${number}: remedy`).toBe(3);
  }
  expect(explanation({ number: 130 }, languages.de)?.cause).toContain("Not-Halt");
  expect(Object.keys(languageAlarms.remedy)).toEqual(Object.keys(languages));
  const remedy = "Die im Text genannte Zeile berichtigen, dann neu starten.";
  for (const number of [languageAlarms.first, 1107, languageAlarms.last]) expect(explanation({ number }, languages.de)).toEqual({ cause: "", remedy });
  expect(explanation({ number: 9999 }, languages.en)).toBeUndefined();
});

test("an alarm says in the operator's language what it is, and keeps the numbers of the service's text", () => {
  const alarm = { number: 111, part: 2, text: "Z: following error 1.25 mm, at most 1 mm" };
  expect(wording(alarm, languages.en)).toEqual({ text: alarm.text, detail: "" });
  expect(wording(alarm, languages.de)).toEqual({ text: "Der Schleppfehler überschreitet seine Grenze", detail: alarm.text });
  expect(wording({ ...alarm, text: "The following error exceeds its limit" }, languages.zh)).toEqual({ text: "跟随误差超过限值", detail: "" });
  expect(wording({ number: 151, part: 0, text: "Werkstück wenden" }, languages.de)).toEqual({ text: "Werkstück wenden", detail: "" });
  expect(wording({ number: 1107, part: 0, text: "A.NC:1:2: G7" }, languages.de)).toEqual({ text: "A.NC:1:2: G7", detail: "" });
});
