// SPDX-License-Identifier: Apache-2.0
// New programs for the PLC: which files, and what the PLC says of them.
import type { PlcPrograms } from "../contract";
import type { Source } from "./source";

/** Files of a directory with programs, as the PLC takes them. */
export const isSource = (name: string): boolean =>
  (name.endsWith(".st") && !name.endsWith("_test.st")) || /\.(exp|EXP|xml)$/.test(name) || ["fast.il", "main.il", "devices.yaml", "messages.yaml", "modbus.yaml"].includes(name);

/** The texts of the programs that run. */
export const runningSources = (programs: PlcPrograms): Promise<Source[]> =>
  Promise.all(
    programs.files.map(async ({ name }) => {
      const answer = await fetch(`/api/plc/programs/${encodeURIComponent(name)}`);
      return { name, text: answer.ok ? await answer.text() : "" };
    }),
  );

export interface SourceFile extends Source {
  /** What runs under this name; undefined: nothing. */
  running: string | undefined;
}

export type FileState = "same" | "changed" | "new";
export const stateOf = ({ text, running }: SourceFile): FileState =>
  running === undefined ? "new" : running === text ? "same" : "changed";

/** The files in the order of their names, with one more or another text of it. */
export function withFile(files: readonly SourceFile[], name: string, text: string): SourceFile[] {
  const before = files.find((file) => file.name === name);
  return [...files.filter((file) => file.name !== name), { name, text, running: before?.running }].sort((a, b) => (a.name < b.name ? -1 : 1));
}

export interface Message {
  kind: "error" | "warning" | "note";
  file: string;
  line: number;
  column: number;
  text: string;
}

/** file:line:column: error: text; anything else is a note without a place. */
export function messageOf(line: string): Message {
  const [, file, row, column, kind, text] = /^([^:\n]+):(\d+):(\d+): (error|warning): ([\s\S]*)$/.exec(line) ?? [];
  if (file === undefined) return { kind: line.includes(": error: ") ? "error" : "note", file: "", line: 0, column: 0, text: line };
  return { kind: kind as "error" | "warning", file, line: Number(row), column: Number(column), text: text! };
}
