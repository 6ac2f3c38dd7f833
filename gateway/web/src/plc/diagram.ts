// SPDX-License-Identifier: Apache-2.0
// Ladders, function block diagrams and charts of PLCopen XML (TC6 2.01): their elements, and where each is drawn.

export type ElementKind =
  | "rail" | "contact" | "coil" | "block" | "variable" | "jump" | "label" | "return" | "connector" | "continuation"
  | "step" | "macro" | "transition" | "actions" | "divergence" | "simultaneous";

export interface Pin {
  name: string;
  negated: boolean;
  from: { id: string; output: string }[];
}

export interface Element {
  id: string;
  kind: ElementKind;
  /** Variable, expression, type of a block, name of a step. */
  text: string;
  /** Of a block: its instance; of an action block: nothing. */
  instance: string;
  negated: boolean;
  edge: string;
  storage: string;
  /** Of a step. */
  initial: boolean;
  inputs: Pin[];
  outputs: { name: string; negated: boolean }[];
  /** Of a macro step: the steps of its chart and of the macro steps in it. */
  steps: string[];
  /** Of an action block: qualifier and action of each line. */
  lines: string[];
  /** In the drawing, px. */
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Diagram {
  language: "LD" | "FBD" | "SFC";
  /** Of the chart of a macro step its name, else empty. */
  macro: string;
  elements: Element[];
  width: number;
  height: number;
}

export interface Unit {
  name: string;
  kind: "program" | "functionBlock" | "function";
  /** Elementary variables of the interface. */
  variables: string[];
  diagrams: Diagram[];
}

const kinds: Record<string, ElementKind> = {
  leftPowerRail: "rail", rightPowerRail: "rail", contact: "contact", coil: "coil", block: "block",
  inVariable: "variable", outVariable: "variable", inOutVariable: "variable",
  jump: "jump", label: "label", return: "return", connector: "connector", continuation: "continuation",
  step: "step", macroStep: "macro", jumpStep: "jump", transition: "transition", actionBlock: "actions",
  selectionDivergence: "divergence", selectionConvergence: "divergence",
  simultaneousDivergence: "simultaneous", simultaneousConvergence: "simultaneous",
};

/** What is read of an element of a document; that of the browser has more. */
export interface Node {
  localName: string;
  textContent: string | null;
  children: ArrayLike<Node>;
  getAttribute(name: string): string | null;
}

const inside = (node: Node | undefined, name?: string): Node[] =>
  node ? Array.from(node.children).filter((one) => name === undefined || one.localName === name) : [];
const first = (node: Node | undefined, ...path: string[]): Node | undefined =>
  path.reduce<Node | undefined>((at, name) => inside(at, name)[0], node);
const words = (node: Node | undefined) => (node?.textContent ?? "").trim().replace(/\s+/g, " ");
const get = (node: Node | undefined, name: string) => node?.getAttribute(name) ?? "";

const connections = (node: Node) =>
  inside(node, "connectionPointIn").flatMap((point) =>
    inside(point, "connection").map((one) => ({ id: get(one, "refLocalId"), output: get(one, "formalParameter") })),
  );

function conditionOf(transition: Node): string {
  const condition = first(transition, "condition");
  const reference = first(condition, "reference");
  if (reference) return get(reference, "name");
  const written = first(condition, "inline");
  return first(written, "ST") ? words(first(written, "ST")) : get(written, "name");
}

const chartOf = (macro: Node): Node | undefined => first(macro, "body", "SFC");
const stepsOf = (macro: Node): string[] =>
  inside(chartOf(macro)).flatMap((one) => (one.localName === "step" ? [get(one, "name")] : one.localName === "macroStep" ? stepsOf(one) : []));

function read(node: Node): (Element & { px: number; py: number }) | undefined {
  const kind = kinds[node.localName];
  if (kind === undefined) return undefined;
  const position = first(node, "position");
  const pins = (list: string) =>
    inside(first(node, list), "variable").map((one) => ({ name: get(one, "formalParameter"), negated: get(one, "negated") === "true", from: connections(one) }));
  const isBlock = kind === "block";
  const inputs = isBlock ? [...pins("inputVariables"), ...pins("inOutVariables")] : [{ name: "", negated: false, from: connections(node) }];
  const text =
    kind === "block" ? get(node, "typeName")
    : kind === "contact" || kind === "coil" ? words(first(node, "variable"))
    : kind === "variable" ? words(first(node, "expression"))
    : kind === "step" || kind === "macro" || kind === "connector" || kind === "continuation" ? get(node, "name")
    : kind === "jump" ? get(node, "label") || get(node, "targetName")
    : kind === "label" ? get(node, "label")
    : kind === "transition" ? conditionOf(node)
    : "";
  const lines = kind !== "actions" ? [] : inside(node, "action").map((one) => {
    const name = get(first(one, "reference"), "name");
    return `${get(one, "qualifier") || "N"} ${get(one, "duration")} ${name || words(first(one, "inline"))}`.replace(/\s+/g, " ").slice(0, 40);
  });
  return {
    id: get(node, "localId"), kind, text, instance: get(node, "instanceName"),
    negated: get(node, "negated") === "true",
    edge: get(node, "edge").replace("none", ""), storage: get(node, "storage").replace("none", ""),
    initial: get(node, "initialStep") === "true",
    steps: kind === "macro" ? stepsOf(node) : [],
    inputs, outputs: isBlock ? pins("outputVariables").map(({ name, negated }) => ({ name, negated })) : [], lines,
    px: Number(get(position, "x") || NaN), py: Number(get(position, "y") || NaN), x: 0, y: 0, width: 0, height: 0,
  };
}

const letter = 7.4, valueWidth = 150, pinHeight = 20, gapX = 34, gapY = 14;  // px

function size(one: Element): void {
  const long = (texts: readonly string[]) => Math.max(0, ...texts.map((text) => text.length)) * letter;
  if (one.kind === "block") {
    one.width = Math.max(90, long([one.text, one.instance]) + 16, long(one.inputs.map(({ name }) => name)) + long(one.outputs.map(({ name }) => name)) + (one.instance ? valueWidth : 30));
    one.height = 36 + pinHeight * Math.max(1, one.inputs.length, one.outputs.length);
  } else if (one.kind === "actions") {
    one.width = long(one.lines) + 16;
    one.height = 10 + pinHeight * Math.max(1, one.lines.length);
  } else if (one.kind === "rail") {
    [one.width, one.height] = [6, 36];
  } else if (one.kind === "divergence" || one.kind === "simultaneous") {
    [one.width, one.height] = [40, 8];
  } else {
    // The condition of a transition is beside its bar.
    one.width = one.kind === "transition" ? 2 * (24 + long([one.text])) : Math.max(56, long([one.text]) + 16);
    one.height = 44;
  }
}

/** Ranks of numbers: the smallest has 0, equal ones have the same. */
function ranks(values: readonly number[]): number[] {
  const sorted = [...new Set(values)].sort((a, b) => a - b);
  return values.map((value) => sorted.indexOf(value));
}

/**
 * Places the elements in columns and rows in the order of their positions in the file, far enough from each other. When
 * positions are missing, an element comes behind those it takes its inputs from (of a chart below them).
 */
function place(found: (Element & { px: number; py: number })[], language: Diagram["language"], macro: string): Diagram {
  const elements = found.filter(({ id }) => id !== "");
  elements.forEach(size);
  const positioned = elements.every(({ px, py }) => Number.isFinite(px) && Number.isFinite(py))
    && new Set(elements.map(({ px, py }) => `${px} ${py}`)).size > 1;
  const depths = new Map<string, number>();
  const byId = new Map(elements.map((one) => [one.id, one]));
  const depth = (id: string, seen: ReadonlySet<string>): number => {
    const known = depths.get(id);
    if (known !== undefined) return known;
    const before = byId.get(id)?.inputs.flatMap(({ from }) => from).filter((one) => byId.has(one.id) && !seen.has(one.id)) ?? [];
    const result = before.length === 0 ? 0 : 1 + Math.max(...before.map((one) => depth(one.id, new Set([...seen, id]))));
    depths.set(id, result);
    return result;
  };
  const along = elements.map((one) => (positioned ? (language === "SFC" ? one.py : one.px) : depth(one.id, new Set([one.id]))));
  const used = new Map<number, number>();
  const across = elements.map((one, i) => {
    if (positioned) return language === "SFC" ? one.px : one.py;
    const next = used.get(along[i]!) ?? 0;
    used.set(along[i]!, next + 1);
    return next;
  });
  const columns = ranks(language === "SFC" ? across : along), rows = ranks(language === "SFC" ? along : across);
  const last = Math.max(0, ...columns);
  const left: number[] = [16];
  for (let column = 0; column <= last; ++column)
    left.push(left[column]! + gapX + Math.max(0, ...elements.filter((_, i) => columns[i] === column).map(({ width }) => width)));
  const bottom = new Map<number, number>();
  let top = 12;
  for (let row = 0; row <= Math.max(0, ...rows); ++row) {
    const here = elements.map((_, i) => i).filter((i) => rows[i] === row);
    top = Math.max(top, ...here.map((i) => (bottom.get(columns[i]!) ?? 0) + gapY));
    for (const i of here) {
      const one = elements[i]!;
      one.x = left[columns[i]!]!;
      // The same column and row: below each other.
      one.y = Math.max(top, (bottom.get(columns[i]!) ?? -gapY) + gapY);
      bottom.set(columns[i]!, one.y + one.height);
    }
    top += 30;
  }
  if (language === "SFC")
    elements.forEach((one, i) => (one.x += (left[columns[i]! + 1]! - gapX - left[columns[i]!]! - one.width) / 2));
  const height = Math.max(0, ...bottom.values()) + 16;
  for (const one of elements) if (one.kind === "rail") one.height = Math.max(36, height - 12 - one.y);
  for (const one of elements) {
    if (one.kind !== "divergence" && one.kind !== "simultaneous") continue;
    const near = elements.filter(({ id, inputs }) => inputs.some(({ from }) => from.some((source) => source.id === one.id)) || one.inputs.some(({ from }) => from.some((source) => source.id === id)));
    const right = Math.max(one.x + 40, ...near.map(({ x, width }) => x + width / 2 + 8));
    one.x = Math.min(one.x, ...near.map(({ x, width }) => x + width / 2 - 8));
    one.width = right - one.x;
  }
  return { language, macro, elements, width: left[last + 1]! + 8, height };
}

const elementary = /^(BOOL|[SDLU]{0,2}INT|L?REAL|[DL]?WORD|BYTE|L?TIME|W?STRING|string|wstring)$/;

/** A body, then the charts of the macro steps in it. */
function drawn(body: Node, language: Diagram["language"], macro: string): Diagram[] {
  const within = inside(body, "macroStep").flatMap((one) => {
    const chart = chartOf(one);
    return chart ? drawn(chart, "SFC", get(one, "name")) : [];
  });
  return [place(inside(body).flatMap((node) => read(node) ?? []), language, macro), ...within];
}

/** The units of a document with what is drawn of them: their bodies in LD, FBD and SFC. */
export function units(root: Node): Unit[] {
  return inside(first(root, "types", "pous"), "pou").map((pou) => ({
    name: get(pou, "name"),
    kind: get(pou, "pouType") as Unit["kind"],
    variables: inside(first(pou, "interface")).filter(({ localName }) => /^(input|output|local)Vars$/.test(localName)).flatMap((list) =>
      inside(list, "variable").filter((one) => get(one, "address") === "" && elementary.test(inside(first(one, "type"))[0]?.localName ?? "")).map((one) => get(one, "name")),
    ),
    diagrams: inside(pou, "body").flatMap((body) =>
      inside(body).flatMap((language) =>
        /^(LD|FBD|SFC)$/.test(language.localName)
          ? drawn(language, language.localName as Diagram["language"], "")
          : [],
      ),
    ),
  }));
}

/** Where the wire of an input ends, and that of an output begins. */
export function inputAt(one: Element, pin: number, language: Diagram["language"]): { x: number; y: number } {
  if (language === "SFC" && one.kind !== "actions") return { x: one.x + one.width / 2, y: one.y };
  return { x: one.x, y: one.kind === "block" ? one.y + 36 + pinHeight * (pin + 0.5) : one.y + (one.kind === "actions" ? 22 : 26) };
}
export function outputAt(one: Element, output: string, language: Diagram["language"], to: Element): { x: number; y: number } {
  if (language === "SFC" && to.kind !== "actions")
    return { x: one.kind === "divergence" || one.kind === "simultaneous" ? Math.min(Math.max(to.x + to.width / 2, one.x), one.x + one.width) : one.x + one.width / 2, y: one.y + one.height };
  if (one.kind === "rail") return { x: one.x + one.width, y: Math.max(inputAt(to, 0, language).y, one.y) };
  const pin = Math.max(0, one.outputs.findIndex(({ name }) => name === output));
  return { x: one.x + one.width, y: one.kind === "block" ? one.y + 36 + pinHeight * (pin + 0.5) : one.y + (to.kind === "actions" ? 22 : 26) };
}
