// SPDX-License-Identifier: Apache-2.0
// A program as bytes with the start of every line: a million lines stay one buffer, and only what is seen is decoded.

export class ProgramText {
  private readonly starts: Uint32Array;
  readonly count: number;
  private readonly decoder = new TextDecoder();

  constructor(private readonly bytes: Uint8Array) {
    let lines = 1;
    for (let at = bytes.indexOf(10); at >= 0; at = bytes.indexOf(10, at + 1)) ++lines;
    if (bytes.length > 0 && bytes[bytes.length - 1] === 10) --lines;
    if (bytes.length === 0) lines = 0;
    this.count = lines;
    this.starts = new Uint32Array(lines + 1);
    let start = 0;
    for (let line = 0; line < lines; ++line) {
      this.starts[line] = start;
      const end = bytes.indexOf(10, start);
      start = end < 0 ? bytes.length + 1 : end + 1;
    }
    this.starts[lines] = start;
  }

  /** The line numbered from 1, without its line end; empty beyond the program. */
  line(number: number): string {
    if (number < 1 || number > this.count) return "";
    const start = this.starts[number - 1]!;
    let end = this.starts[number]! - 1;
    if (end > start && this.bytes[end - 1] === 13) --end;
    return this.decoder.decode(this.bytes.subarray(start, end));
  }
}

/** The first line to show so that `line` is in the window: unmoved while it is well inside, else a third from the top. */
export function follow(first: number, visible: number, line: number, count: number): number {
  const last = Math.max(1, count - visible + 1);
  if (line < 1) return Math.min(Math.max(1, first), last);
  const inside = line >= first + 1 && line <= first + visible - 3;
  return Math.min(Math.max(1, inside ? first : line - Math.floor(visible / 3)), last);
}
