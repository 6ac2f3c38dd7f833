// SPDX-License-Identifier: Apache-2.0
// The life of a tool as the table keeps it. Whoever changes the tool or a program of the plant enters what is used.
import type { Tool } from "../contract";
import type { Texts } from "../text/texts";

type Life = Pick<Tool, "life_used" | "life_limit" | "life_unit">;

export const lifeUnit = ({ life_unit }: Life, t: Pick<Texts, "lifeMinutes" | "lifePieces">) => (life_unit === "PIECES" ? t.lifePieces : t.lifeMinutes);

/** To a tenth, without zeros behind. */
export const lifeNumber = (value: number) => String(Math.round(value * 10) / 10);

/** 12.5 / 90 min; without a limit what is used alone; nothing entered is a dash. */
export function lifeText(tool: Life, t: Pick<Texts, "lifeMinutes" | "lifePieces">): string {
  const { life_used: used, life_limit: limit } = tool;
  if (used === 0 && limit === 0) return "–";
  return `${lifeNumber(used)}${limit > 0 ? ` / ${lifeNumber(limit)}` : ""} ${lifeUnit(tool, t)}`;
}

export const isUsedUp = ({ life_used, life_limit }: Life) => life_limit > 0 && life_used >= life_limit;
