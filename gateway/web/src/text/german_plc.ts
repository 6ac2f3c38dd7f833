// SPDX-License-Identifier: Apache-2.0
import type { englishPlc } from "./english_plc";
import type { Texts } from "./texts";

export const germanPlc: Pick<Texts, keyof typeof englishPlc> = {
  plcPrograms: "SPS-Programme",
  plcBack: "Register und Dienste",
  plcFile: "Datei",
  plcInstance: "Instanz",
  plcSource: "Quelltext",
  plcDelivered: "die der Maschine",
  plcLoadedOnline: (changes) => `online geladen, ${changes} Änderungen`,
  plcVariables: "Variablen",
  plcFind: "Variable suchen",
  plcFound: (shown, total) => `${shown} von ${total}`,
  plcWatch: (path) => `${path} beobachten`,
  plcWatched: "Beobachtete Variablen",
  plcNothingWatched: "Variablen aus der Liste wählen.",
  plcForce: "Forcen",
  plcForceValue: (path) => `Wert, auf den ${path} geforct wird`,
  plcRelease: (path) => `${path} freigeben`,
  plcReleaseAll: "Alle freigeben",
  plcForced: "geforct",
  plcForces: (count) => `${count} geforct`,
  plcForceQuestion: (path, value) => `${path} auf ${value} forcen? Die Programme können den Wert dann nicht mehr ändern, und Ausgänge wirken auf die Maschine.`,
  plcTrace: "Aufzeichnung",
  plcTraceAbout: "Werte der beobachteten Variablen nach jedem Zyklus",
  plcScans: "Zyklen",
  plcTraceStart: "Aufzeichnen",
  plcTraceRows: (rows, scans) => `${rows} von ${scans} Zyklen`,
};
