// SPDX-License-Identifier: Apache-2.0
// A program as bytes with the start of every line: a million lines stay one buffer, and only what is seen is decoded.

const lineFeed = 10, carriage = 13;

/** Where the line that begins at `from` ends and the next begins: LF, CR LF or CR ends it, or the text. */
function lineEnd(bytes: Uint8Array, from: number): [end: number, next: number] {
  for (let at = from; at < bytes.length; ++at) {
    if (bytes[at] === lineFeed) return [at, at + 1];
    if (bytes[at] === carriage) return [at, bytes[at + 1] === lineFeed ? at + 2 : at + 1];
  }
  return [bytes.length, bytes.length];
}

/** What ends the lines of a text; LF when they end in several ways. */
export function lineBreak(text: string): string {
  if (!text.includes("\n")) return text.includes("\r") ? "\r" : "\n";
  return /(^|[^\r])\n/.test(text) ? "\n" : "\r\n";
}

export class ProgramText {
  private readonly starts: Uint32Array;
  readonly count: number;
  private readonly decoder = new TextDecoder("utf-8", { fatal: true });
  private readonly oldDecoder = new TextDecoder("windows-1252");

  constructor(private readonly bytes: Uint8Array) {
    let lines = 0;
    for (let at = 0; at < bytes.length; at = lineEnd(bytes, at)[1]) ++lines;
    this.count = lines;
    this.starts = new Uint32Array(lines);
    for (let line = 0, at = 0; line < lines; ++line, at = lineEnd(bytes, at)[1]) this.starts[line] = at;
  }

  /** The line numbered from 1, without its line end; empty beyond the program. */
  line(number: number): string {
    if (number < 1 || number > this.count) return "";
    const start = this.starts[number - 1]!;
    const line = this.bytes.subarray(start, lineEnd(this.bytes, start)[0]);
    try {
      return this.decoder.decode(line);
    } catch {
      return this.oldDecoder.decode(line); // comments of older programs
    }
  }
}

/** The first line to show so that `line` is in the window: unmoved while it is well inside, else a third from the top. */
export function follow(first: number, visible: number, line: number, count: number): number {
  const last = Math.max(1, count - visible + 1);
  if (line < 1) return Math.min(Math.max(1, first), last);
  const inside = line >= first + 1 && line <= first + visible - 3;
  return Math.min(Math.max(1, inside ? first : line - Math.floor(visible / 3)), last);
}
