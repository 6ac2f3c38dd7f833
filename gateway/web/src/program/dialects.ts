// SPDX-License-Identifier: Apache-2.0
import type { ProgramDialect } from "../contract";

/** Before a line of MDI that the page writes: such lines are ISO whatever the channel reads. */
export const isoHead = "(DIALECT: ISO) ";

/** Dialects as the controls are called. */
export const dialectNames: Readonly<Record<ProgramDialect, string>> = { iso: "ISO", num: "NUM", linuxcnc: "LinuxCNC", haas: "Haas" };
