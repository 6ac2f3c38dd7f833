// SPDX-License-Identifier: Apache-2.0
import type { englishAccess } from "./english_access";
import type { Translation } from "./translation";

export const germanAccess: Translation<typeof englishAccess> = {
  loginTitle: "Anmelden",
  loginAbout: "Not-Halt und Vorschub-Halt wirken ohne Anmeldung.",
  userName: "Benutzer",
  password: "Passwort",
  login: "Anmelden",
  logout: "Abmelden",
  authOff: "ohne Anmeldung",
  authOffAbout: "Jeder an diesem Rechner darf die Maschine bedienen: auth ist in machine.yaml ausgeschaltet.",
  needsRole: (needed, name, has) => `Dafür ist die Rolle ${needed} nötig; ${name} ist ${has}.`,
  roleOperator: "Bediener",
  roleSetter: "Einrichter",
  roleBuilder: "Maschinenhersteller",
  roleAdministrator: "Verwalter",
  sessionOver: "Die Sitzung ist beendet. Bitte wieder anmelden.",
  youOperate: "Sie bedienen",
  otherOperates: (name) => `${name} bedient`,
  nobodyOperates: "Niemand bedient",
  operateHere: "Hier bedienen",
  takeOverRight: "Übernehmen",
  askForRight: "Um Bedienung bitten",
  asking: "Gebeten…",
  askedFor: (name) => `${name} wird um das Bedienrecht gebeten.`,
  giveBack: "Abgeben",
  othersAsk: (name) => `${name} bittet darum, diese Maschine zu bedienen.`,
  handOver: "Übergeben",
  keepRight: "Behalten",
  watchOnly: (name) => `${name} bedient: Diese Station sieht zu. Not-Halt und Vorschub-Halt wirken auch hier.`,
};
