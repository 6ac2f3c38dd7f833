// SPDX-License-Identifier: Apache-2.0
import type { englishAccess } from "./english_access";
import type { Texts } from "./texts";

export const germanAccess: Pick<Texts, keyof typeof englishAccess> = {
  loginTitle: "Anmelden",
  loginAbout: "Not-Halt und Vorschub-Halt wirken ohne Anmeldung.",
  userName: "Benutzer",
  password: "Passwort",
  login: "Anmelden",
  logout: "Abmelden",
  authOff: "ohne Anmeldung",
  authOffAbout: "Jeder an diesem Rechner darf die Maschine bedienen: auth ist in machine.yaml ausgeschaltet.",
};
