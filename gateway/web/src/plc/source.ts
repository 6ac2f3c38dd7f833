// SPDX-License-Identifier: Apache-2.0
// Which variables a line of Structured Text names, so that their values can be shown beside it.
import { inputNames, registerNames } from "./input_catalogue";

export interface SourceLine {
  text: string;
  /** Names as written, without those in comments and strings, each once. */
  names: string[];
  /** Of the unit around it: a program, function block or class, empty outside. */
  unit: string;
  kind: "PROGRAM" | "FUNCTION_BLOCK" | "";
}

const nameOf = /%[A-Za-z]+\d+(?:\.\d+)?|[A-Za-z_]\w*(?:\[[\w, ]*\])?(?:\.[A-Za-z_]\w*(?:\[[\w, ]*\])?)*/g;

/** Behind the comment that begins at `start`; comments of one kind nest. */
function commentEnd(source: string, start: number): number {
  const marks = source[start] === "(" ? /\(\*|\*\)/g : /\/\*|\*\//g;
  marks.lastIndex = start;
  let depth = 0;
  for (let mark = marks.exec(source); mark; mark = marks.exec(source)) {
    depth += mark[0].startsWith("*") ? -1 : 1;
    if (depth === 0) return marks.lastIndex;
  }
  return source.length;
}

/** Comments and strings become blanks of the same length, so that lines stay lines. */
function blanked(source: string): string {
  const begin = /\(\*|\/\*|\/\/[^\n]*|'(?:\$.|[^'\n])*'|"(?:\$.|[^"\n])*"/g;
  let result = "";
  let done = 0;
  for (let found = begin.exec(source); found; found = begin.exec(source)) {
    const nests = found[0] === "(*" || found[0] === "/*";
    const end = nests ? commentEnd(source, found.index) : begin.lastIndex;
    result += source.slice(done, found.index) + source.slice(found.index, end).replace(/[^\n]/g, " ");
    done = end;
    begin.lastIndex = end;
  }
  return result + source.slice(done);
}

const isXml = (source: string) => /^\s*(?:\uFEFF)?<\?xml|^\s*<(?:\w+:)?project\b/.test(source);

/** Of PLCopen XML: the variables of contacts, coils and connections, and of steps whether they are active and for how long. */
function documentLines(source: string): SourceLine[] {
  let unit = "";
  let kind: SourceLine["kind"] = "";
  return source.split("\n").map((text) => {
    const pou = /<(?:\w+:)?pou\s[^>]*/.exec(text)?.[0];
    if (pou !== undefined) {
      unit = /\bname="(\w+)"/.exec(pou)?.[1] ?? "";
      kind = pou.includes('pouType="program"') ? "PROGRAM" : pou.includes('pouType="functionBlock"') ? "FUNCTION_BLOCK" : "";
    }
    const step = /<(?:\w+:)?step\s[^>]*\bname="(\w+)"/.exec(text)?.[1];
    const inside = [...text.matchAll(/<(?:\w+:)?(?:variable|expression)>([^<]*)</g)].flatMap(([, one]) => blanked(one!).match(nameOf) ?? []);
    const names = step === undefined ? [...new Set(inside)] : [`${step}.X`, `${step}.T`];
    return { text, names, unit, kind };
  });
}

/** The program of an instruction list, which has the name of its file; empty for other files. */
export const listProgram = (file: string): string => /^(\w+)\.il$/.exec(file)?.[1] ?? "";

/** The function block that an instruction with a number calls: TON 3, 500 calls ton_3. */
function numberedBlock(line: string): string[] {
  const [, name, number] = /(?:^|:)\s*(TON|TOF|CTU|R_TRIG|F_TRIG)\s+(\d+)/i.exec(line) ?? [];
  return name === undefined || number === undefined ? [] : [`${name.toLowerCase()}_${number}.Q`];
}

/** `program`: that of an instruction list. */
export function sourceLines(source: string, program = ""): SourceLine[] {
  if (isXml(source)) return documentLines(source);
  const lines = source.split("\n");
  const code = blanked(source).split("\n");
  let unit = program;
  let kind: SourceLine["kind"] = program === "" ? "" : "PROGRAM";
  return lines.map((text, index) => {
    const line = code[index] ?? "";
    const begins = /^\s*(PROGRAM|FUNCTION_BLOCK|FUNCTION|TEST|CLASS(?=\s+\w))\s+(?:(?:FINAL|ABSTRACT)\s+)*(\w*)/i.exec(line);
    if (begins) {
      const word = begins[1]!.toUpperCase().replace("CLASS", "FUNCTION_BLOCK");
      kind = word === "PROGRAM" || word === "FUNCTION_BLOCK" ? word : "";
      unit = kind === "" ? "" : begins[2]!;
    }
    const names = begins ? [] : [...new Set([...(line.match(nameOf) ?? []), ...(program === "" ? [] : numberedBlock(line))])];
    const found = { text, names, unit, kind };
    if (/^\s*END_(PROGRAM|FUNCTION_BLOCK|FUNCTION|TEST|CLASS)\b/i.test(line)) [unit, kind] = ["", ""];
    return found;
  });
}

const registerOf = (upper: string): string | undefined => {
  const name = upper.toLowerCase();
  return registerNames.has(name) || (/_\d+$/.test(name) && registerNames.has(name.replace(/\d+$/, ""))) ? name : undefined;
};

/** Paths of the variables of the PLC, found whatever the case. */
export class Paths {
  private readonly byName = new Map<string, string>();
  constructor(paths: readonly string[]) {
    for (const path of paths) this.byName.set(path.toUpperCase(), path);
  }

  /** Of a name within `prefix`, which is the program or an instance of a function block; of a register as it is. */
  find(name: string, prefix: string): string | undefined {
    const upper = name.replaceAll(" ", "").toUpperCase();
    return this.byName.get(`${prefix.toUpperCase()}.${upper}`) ?? this.byName.get(upper) ?? (upper.startsWith("%") ? upper : registerOf(upper));
  }

  /** Instances of a function block: what has every one of `names`, which the block declares. */
  instances(names: readonly string[]): string[] {
    const first = names[0]?.toUpperCase();
    if (first === undefined) return [];
    const within = (prefix: string, name: string) =>
      this.byName.has(`${prefix}.${name}`) || [...this.byName.keys()].some((path) => path.startsWith(`${prefix}.${name}.`) || path.startsWith(`${prefix}.${name}[`));
    const prefixes = new Set<string>();
    for (const [upper, path] of this.byName) {
      const at = upper.endsWith(`.${first}`) ? upper.length - first.length - 1 : -1;
      if (at > 0 && names.every((name) => within(upper.slice(0, at), name.toUpperCase()))) prefixes.add(path.slice(0, at));
    }
    return [...prefixes].sort();
  }

  /** Where the variables of a unit are: of a program under its name, or, as those of a function block, in its instances. */
  prefixes(program: string, names: readonly string[]): string[] {
    const begins = `${program.toUpperCase()}.`;
    return program !== "" && [...this.byName.keys()].some((path) => path.startsWith(begins)) ? [program] : this.instances(names);
  }
}

/** Names that a program or function block declares as elementary variables, without those of a place (AT), of functions and of methods within. */
export function declared(source: string, unit: string): string[] {
  if (isXml(source)) {
    const pou = new RegExp(`<(?:\\w+:)?pou\\s[^>]*\\bname="${unit}"[\\s\\S]*?</(?:\\w+:)?interface>`).exec(source)?.[0] ?? "";
    return [...pou.matchAll(/<(?:\w+:)?variable\s+name="(\w+)"\s*>\s*<(?:\w+:)?type>\s*<(?:\w+:)?(?:BOOL|[SDLU]{0,2}INT|L?REAL|[DL]?WORD|BYTE|L?TIME)\s*\//g)].map(([, name]) => name!);
  }
  const code = blanked(source);
  const body = (new RegExp(`(?:PROGRAM|FUNCTION_BLOCK|CLASS)\\s+(?:(?:FINAL|ABSTRACT)\\s+)*${unit}\\b([\\s\\S]*?)END_(?:PROGRAM|FUNCTION_BLOCK|CLASS)`, "i").exec(code)?.[1] ?? "")
    .replace(/\bMETHOD\b[\s\S]*?\bEND_METHOD\b/gi, "");
  const names: string[] = [];
  for (const section of body.matchAll(/\bVAR(?:_INPUT|_OUTPUT)?\b(?!\s+CONSTANT)([\s\S]*?)END_VAR/gi))
    for (const line of section[1]!.matchAll(/([\w, \n]+?)\s*:\s*(?:BOOL|[SDLU]{0,2}INT|L?REAL|[DL]?WORD|BYTE|L?TIME|STRING)\b/gi))
      for (const name of line[1]!.split(",")) if (/^\s*\w+\s*$/.test(name)) names.push(name.trim());
  return names.filter((name) => !/^(RETAIN)$/i.test(name));
}

export interface Source {
  name: string;
  text: string;
}

export interface InputBit {
  /** %X16.0 */
  address: string;
  /** What the sources call it; empty without a name. */
  name: string;
}

/** Whether it is Structured Text, also an export of CoDeSys. */
export const isText = (file: string): boolean => /\.(st|exp|EXP)$/.test(file);

/** The bits of area X that every machine has, and those that the sources and the file of the simulated devices name, in order. */
export function inputBits(sources: readonly Source[]): InputBit[] {
  const names = new Map(Object.entries(inputNames).map(([address, name]) => [address.slice(1), name]));
  for (const { name: file, text } of sources) {
    if (!isText(file) && file !== "devices.yaml") continue;
    const code = isText(file) ? blanked(text) : text.replace(/#[^\n]*/g, "");
    for (const [, bit] of code.matchAll(/%?\bI?X(\d+\.[0-7])\b/gi)) if (!names.has(bit!)) names.set(bit!, "");
    for (const [, name, bit] of code.matchAll(/(\w+)\s+AT\s+%I?X(\d+\.[0-7])\b/gi)) names.set(bit!, name!);
  }
  return [...names].map(([bit, name]) => ({ address: `%X${bit}`, name })).sort((a, b) => Number(a.address.slice(2)) - Number(b.address.slice(2)));
}

/** Simulated devices with the paths of their values: what is in the program `simulation`. */
export function devices(all: readonly string[]): Map<string, string[]> {
  const found = new Map<string, string[]>();
  for (const path of all) {
    const [, name] = /^simulation\.(\w+)/i.exec(path) ?? [];
    if (name) found.set(name, [...(found.get(name) ?? []), path]);
  }
  return found;
}
