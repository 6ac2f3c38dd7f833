// SPDX-License-Identifier: Apache-2.0
// What a program consists of: program heads, tool changes, work offsets, calls, labels and comments of their own.
import { codeName, tokens } from "./g_code";

export interface OutlineEntry {
  /** From 1. */
  line: number;
  kind: "program" | "tool" | "offset" | "call" | "label" | "comment";
  text: string;
}

export const mostEntries = 400;
/** More labels than this number every block, and lead nowhere. */
const mostLabels = 60;

const offsets = /^G5[4-9](\.1)?$/;
const calls = new Set(["M98", "G65", "G66", "G66.1"]);

export function outline(lines: Iterable<string>): OutlineEntry[] {
  const entries: OutlineEntry[] = [];
  let [number, labels] = [0, 0];
  for (const line of lines) {
    ++number;
    if (!/[(O%:<NTGM;]/i.test(line)) continue;
    const parts = tokens(line).map(({ from, to, kind }) => ({ kind, text: line.slice(from, to) }));
    const codes = parts.filter(({ kind }) => kind === "code").map(({ text }) => codeName(text));
    const comment = parts.find(({ kind }) => kind === "comment")?.text.replace(/^[(;]\s*|\s*\)$/g, "") ?? "";
    const head = parts.find(({ kind, text }) => kind === "head" && text.length > 1);
    const word = (letter: string) => parts.find(({ kind, text }) => kind === "word" && text.toUpperCase().startsWith(letter))?.text;
    const add = (kind: OutlineEntry["kind"], text: string) =>
      entries.push({ line: number, kind, text: comment && kind !== "comment" ? `${text}  ${comment}` : text });
    if (head) add("program", head.text.toUpperCase());
    else if (word("T") && codes.includes("M6")) add("tool", `${word("T")!.toUpperCase()} M6`);
    else if (codes.some((code) => calls.has(code))) add("call", line.replace(/\([^)]*\)?|;.*/g, "").trim());
    else if (codes.some((code) => offsets.test(code))) add("offset", codes.filter((code) => offsets.test(code)).join(" ") + (codes.includes("G54.1") ? ` ${word("P") ?? ""}` : ""));
    else if (parts.some(({ kind }) => kind === "label")) {
      add("label", parts.find(({ kind }) => kind === "label")!.text.toUpperCase());
      ++labels;
    } else if (comment && parts.every(({ kind }) => kind === "comment")) add("comment", comment);
  }
  const shown = labels > mostLabels ? entries.filter(({ kind, text }) => kind !== "label" || text.includes("  ")) : entries;
  return shown.slice(0, mostEntries);
}
