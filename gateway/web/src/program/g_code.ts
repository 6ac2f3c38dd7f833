// SPDX-License-Identifier: Apache-2.0
// The words of a line of G code, for colours and explanations. The checker of the control decides what is right.
import { callCodes, gCodes, mCodes } from "./code_catalogue";

export type TokenKind =
  | "comment" | "head" | "skip" | "label" | "code" | "unknown" | "axis" | "word" | "variable" | "keyword" | "operator";

export interface Token {
  from: number;
  to: number;
  kind: TokenKind;
}

const patterns: [RegExp, TokenKind][] = [
  [/\([^)]*\)?|;.*/y, "comment"],
  [/#\d+|#(?=\[)/y, "variable"],
  [/[A-Z][A-Z]+\d*/iy, "keyword"],
  [/[GM]\s*\d+(?:\.\d+)?/iy, "code"],
  [/N\s*\d+/iy, "label"],
  [/[XYZABCUVWIJK](?=\s*[-+.\d#[])\s*[-+]?\d*\.?\d*/iy, "axis"],
  [/[A-Z]\s*[-+]?\d*\.?\d*/iy, "word"],
  [/[-+*/=[\],<>]/y, "operator"],
];

/** The code as the catalogue writes it: "g01" -> "G1", "G54.10" -> "G54.1". */
export function codeName(text: string): string {
  const [, letter, whole, tenths] = /^([GM])\s*(\d+)(\.\d+)?$/i.exec(text) ?? [];
  if (!letter || !whole) return text;
  const fraction = tenths && Number(tenths) !== 0 ? tenths.replace(/0+$/, "") : "";
  return `${letter.toUpperCase()}${Number(whole)}${fraction}`;
}

/** What a code does; undefined when the control does not have it. Other M codes up to M9999 are the PLC's: "". */
export function aboutCode(text: string): string | undefined {
  const name = codeName(text);
  const known = gCodes[name] ?? mCodes[name];
  if (known !== undefined) return known;
  const number = Number(name.slice(1));
  if (name.startsWith("M")) return Number.isInteger(number) && number <= 9999 ? "" : undefined;
  return callCodes.find(([first, last]) => number >= Number(first.slice(1)) && number <= Number(last.slice(1)))?.[2];
}

/** Tokens of a line, ascending, without its blanks and plain numbers. `marked`: codes that the catalogue lacks are unknown. */
export function tokens(line: string, marked = true): Token[] {
  const found: Token[] = [];
  let at = 0;
  const head = /^\s*(?:%(?:\s*[O:]?\s*\d+)?|[O:]\s*\d+|O?<[^>]*>)/i.exec(line) ?? /^\s*\/[1-9]?/.exec(line);
  if (head) {
    found.push({ from: head[0].search(/\S/), to: head[0].length, kind: /^\s*\//.test(head[0]) ? "skip" : "head" });
    at = head[0].length;
    // The title of the tape.
    if (/^\s*%$/.test(head[0]) && line.slice(at).trim() !== "") {
      found.push({ from: at + line.slice(at).search(/\S/), to: line.length, kind: "comment" });
      return found;
    }
  }
  scan: while (at < line.length) {
    for (const [pattern, kind] of patterns) {
      pattern.lastIndex = at;
      const match = pattern.exec(line);
      if (!match || match[0] === "") continue;
      const from = at;
      at += match[0].length;
      found.push({ from, to: at, kind: marked && kind === "code" && aboutCode(match[0]) === undefined ? "unknown" : kind });
      continue scan;
    }
    ++at;
  }
  return found;
}

/** The code of a line at a column from 0, with its meaning. */
export function explainedAt(line: string, column: number): { from: number; to: number; name: string; about: string } | undefined {
  const token = tokens(line).find(({ from, to, kind }) => kind === "code" && from <= column && column < to);
  if (!token) return undefined;
  const name = codeName(line.slice(token.from, token.to));
  const about = aboutCode(name);
  return about ? { from: token.from, to: token.to, name, about } : undefined;
}
