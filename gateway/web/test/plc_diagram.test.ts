// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { type Node, units } from "../src/plc/diagram";
import { PowerFlow } from "../src/plc/power";
import { declared, Paths } from "../src/plc/source";

/** Elements and attributes only, as far as the drawing reads them. */
function parse(text: string): Node {
  const root = { localName: "", attributes: new Map<string, string>(), children: [] as Node[], textContent: "", getAttribute: (_: string) => null };
  const open: { children: Node[]; textContent: string }[] = [root as never];
  for (const [, end, name, attributes, empty, words] of text.matchAll(/<(\/?)(\w+)((?:\s+\w+="[^"]*")*)\s*(\/?)>|([^<]+)/g)) {
    if (words !== undefined) {
      for (const one of open) one.textContent += words;
    } else if (end) {
      open.pop();
    } else {
      const values = new Map([...attributes!.matchAll(/(\w+)="([^"]*)"/g)].map(([, key, value]) => [key!, value!]));
      const node = { localName: name!, children: [] as Node[], textContent: "", getAttribute: (key: string) => values.get(key) ?? null };
      open.at(-1)!.children.push(node);
      if (!empty) open.push(node as never);
    }
  }
  return root.children[0]!;
}

const point = (...ids: number[]) => `<connectionPointIn>${ids.map((id) => `<connection refLocalId="${id}"/>`).join("")}</connectionPointIn>`;
const contact = (id: number, name: string, from: string, more = "") => `<contact localId="${id}"${more}>${from}<variable>${name}</variable></contact>`;
const pou = (body: string) => `<project>
<types><pous><pou name="Pump" pouType="functionBlock">
<interface><inputVars>
<variable name="a"><type><BOOL/></type></variable>
<variable name="b"><type><BOOL/></type></variable>
</inputVars><localVars><variable name="t"><type><derived name="TON"/></type></variable></localVars></interface>
<body>${body}</body>
</pou></pous></types></project>`;

const ladder = pou(`<LD><leftPowerRail localId="1"/>
${contact(2, "a", point(1))}
${contact(3, "b", point(1), ' negated="true"')}
<coil localId="4">${point(2, 3)}<variable>q</variable></coil>
<block localId="5" typeName="TON" instanceName="t"><inputVariables><variable formalParameter="IN">${point(2)}</variable></inputVariables>
<outputVariables><variable formalParameter="Q"/></outputVariables></block>
<block localId="6" typeName="GT"><inputVariables><variable formalParameter="EN">${point(2)}</variable></inputVariables>
<outputVariables><variable formalParameter="OUT"/></outputVariables></block>
</LD>`);

test("power flows through contacts and branches, and is unknown behind a function", () => {
  const unit = units(parse(ladder))[0]!;
  const diagram = unit.diagrams[0]!;
  expect(unit).toMatchObject({ name: "Pump", kind: "functionBlock", variables: ["a", "b"] });
  const flow = (values: Record<string, string>) => {
    const power = new PowerFlow(diagram, (name) => values[name]);
    const coil = diagram.elements.find(({ kind }) => kind === "coil")!;
    return [power.output("2"), power.output("3"), power.input(coil.inputs[0]), power.output("5", "Q"), power.output("6", "OUT"), power.output("6", "ENO")];
  };
  expect(flow({ a: "TRUE", b: "TRUE", "t.Q": "FALSE" })).toEqual([true, false, true, false, undefined, true]);
  expect(flow({ a: "FALSE", b: "TRUE", "t.Q": "TRUE" })).toEqual([false, false, false, true, undefined, false]);
  // One branch has power, whatever the other one has.
  expect(flow({ b: "FALSE" })).toEqual([undefined, true, true, undefined, undefined, undefined]);
});

test("a circle of connections has no known power", () => {
  const diagram = units(parse(pou(`<LD>${contact(1, "a", point(2))}${contact(2, "b", point(1))}</LD>`)))[0]!.diagrams[0]!;
  expect(new PowerFlow(diagram, () => "TRUE").output("1")).toBe(undefined);
});

test("elements do not cover each other, with and without positions", () => {
  const spread = ladder.replace(/localId="(\d)"([^>]*)>/g, (_, id: string, more: string) =>
    more.endsWith("/") ? `localId="${id}"${more.slice(0, -1)}><position x="0" y="0"/></leftPowerRail>` : `localId="${id}"${more}><position x="${Number(id) % 3}" y="${Math.floor(Number(id) / 2)}"/>`);
  for (const text of [ladder, spread]) {
    const { elements, width, height } = units(parse(text))[0]!.diagrams[0]!;
    expect(elements).toHaveLength(6);
    const solid = elements.filter(({ kind }) => kind !== "rail");
    for (const one of solid) {
      expect(one.x + one.width).toBeLessThanOrEqual(width);
      expect(one.y + one.height).toBeLessThanOrEqual(height);
      for (const other of solid)
        if (one !== other)
          expect(one.x + one.width <= other.x || other.x + other.width <= one.x || one.y + one.height <= other.y || other.y + other.height <= one.y).toBe(true);
    }
  }
});

test("the variables of a block in a document are in its instances", () => {
  const paths = new Paths(["main.p.a", "main.p.b", "main.p.q", "main.p.t.Q"]);
  expect(declared(ladder, "Pump")).toEqual(["a", "b"]);
  expect(paths.prefixes("", ["a", "b"])).toEqual(["main.p"]);
});

test("a program runs under its name or under those of its instances", () => {
  const paths = new Paths(["main.speed", "left.moved", "left.start", "right.moved", "right.start"]);
  expect(paths.prefixes("main", ["speed"])).toEqual(["main"]);
  expect(paths.prefixes("conveyor", ["moved", "start"])).toEqual(["left", "right"]);
});

test("the chart of a macro step is drawn after its own, and the macro step is active while one of its steps is", () => {
  const step = (id: number, name: string, from = "") => `<step localId="${id}" name="${name}">${from}</step>`;
  const chart = (body: string) => `<SFC>${body}</SFC>`;
  const inner = chart(step(11, "open"));
  const unit = units(parse(pou(chart(`${step(1, "wait")}<macroStep localId="2" name="work">${point(1)}<body>${chart(
    `${step(3, "first")}<macroStep localId="4" name="deep">${point(3)}<body>${inner}</body></macroStep>`,
  )}</body></macroStep>`))))[0]!;
  expect(unit.diagrams.map(({ macro, elements }) => [macro, elements.map(({ kind, text }) => `${kind} ${text}`)])).toEqual([
    ["", ["step wait", "macro work"]], ["work", ["step first", "macro deep"]], ["deep", ["step open"]],
  ]);
  const work = unit.diagrams[0]!.elements[1]!;
  expect(work.steps).toEqual(["first", "open"]);
  const active = (values: Record<string, string>) => new PowerFlow(unit.diagrams[0]!, (name) => values[name]).active(work);
  expect(active({ "first.X": "FALSE", "open.X": "TRUE" })).toBe(true);
  expect(active({ "first.X": "FALSE", "open.X": "FALSE" })).toBe(false);
  expect(active({ "first.X": "FALSE" })).toBe(undefined);
});
