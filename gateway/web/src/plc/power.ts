// SPDX-License-Identifier: Apache-2.0
// Power flow of a drawn ladder or function block diagram, from the values of its variables.
import type { Diagram, Element, Pin } from "./diagram";

/** undefined: not known, because a function would have to be computed, an edge seen or a value is not there yet. */
export type Power = boolean | undefined;

const and = (a: Power, b: Power): Power => (a === false || b === false ? false : a === undefined || b === undefined ? undefined : true);
const or = (a: Power, b: Power): Power => (a === true || b === true ? true : a === undefined || b === undefined ? undefined : false);
const negated = (power: Power, negates: boolean): Power => (power === undefined || !negates ? power : !power);

/** `value` gives the text of a variable by the expression of the drawing, undefined without one. */
export class PowerFlow {
  private readonly byId: ReadonlyMap<string, Element>;
  private readonly known = new Map<string, Power>();
  private readonly open = new Set<string>();

  constructor(private readonly diagram: Diagram, private readonly value: (expression: string) => string | undefined) {
    this.byId = new Map(diagram.elements.map((one) => [one.id, one]));
  }

  truth(expression: string): Power {
    const text = /^(TRUE|FALSE)$/i.test(expression) ? expression.toUpperCase() : this.value(expression);
    return text === "TRUE" ? true : text === "FALSE" ? false : undefined;
  }

  /** Of a macro step: any step of its chart is active. */
  active(macro: Element): Power {
    return macro.steps.map((step) => this.truth(`${step}.X`)).reduce<Power>(or, false);
  }

  /** What arrives: of several wires, one with power is enough. Nothing connected: no power. */
  input(pin: Pin | undefined): Power {
    if (!pin) return false;
    const sum = pin.from.map(({ id, output }) => this.output(id, output)).reduce<Power>(or, false);
    return negated(sum, pin.negated);
  }

  /** Through a contact, out of a block: what leaves the element. */
  output(id: string, output = ""): Power {
    const key = `${id} ${output}`;
    if (this.known.has(key)) return this.known.get(key);
    if (this.open.has(key)) return undefined;
    this.open.add(key);
    const result = this.compute(id, output);
    this.open.delete(key);
    this.known.set(key, result);
    return result;
  }

  private compute(id: string, output: string): Power {
    const one = this.byId.get(id);
    if (!one) return undefined;
    switch (one.kind) {
      case "rail":
        return true;
      case "contact":
        return and(this.input(one.inputs[0]), one.edge ? undefined : negated(this.truth(one.text), one.negated));
      case "coil":
      case "connector":
        return this.input(one.inputs[0]);
      case "continuation": {
        const from = this.diagram.elements.find(({ kind, text }) => kind === "connector" && text === one.text);
        return from ? this.output(from.id) : undefined;
      }
      case "variable":
        return negated(this.truth(one.text), one.negated);
      case "block": {
        if (output === "ENO") {
          const enable = one.inputs.find(({ name }) => name === "EN");
          return enable && enable.from.length > 0 ? this.input(enable) : true;
        }
        const pin = one.outputs.find(({ name }) => name === output) ?? one.outputs[0];
        return one.instance && pin ? negated(this.truth(`${one.instance}.${pin.name}`), pin.negated) : undefined;
      }
      case "macro":
        return this.active(one);
      case "step":
        return this.truth(`${one.text}.X`);
      default:
        return this.input(one.inputs[0]);
    }
  }
}
