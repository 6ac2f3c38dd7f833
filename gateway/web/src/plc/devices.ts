// SPDX-License-Identifier: Apache-2.0
// The simulated devices of devices.yaml, and what a hand can do at each: docs/plc.md, simulated devices.

/** A value of YAML as devices.yaml uses it: maps, lists and scalars, in blocks by indentation or in braces. */
export type Yaml = string | Yaml[] | { [key: string]: Yaml };

/** `{a: X1.0, b: [1, 2]}`, `[1, 2]` or a scalar. */
function flow(text: string): Yaml {
  let at = 0;
  const blank = () => {
    while (/\s/.test(text[at] ?? "")) ++at;
  };
  const scalar = (end: RegExp): string => {
    blank();
    const quote = text[at];
    if (quote === '"' || quote === "'") {
      const close = text.indexOf(quote, at + 1);
      const inside = text.slice(at + 1, close);
      at = close + 1;
      return inside;
    }
    const begin = at;
    while (at < text.length && !end.test(text.slice(at, at + 2))) ++at;
    return text.slice(begin, at).trim();
  };
  const value = (end: RegExp): Yaml => {
    blank();
    const open = text[at];
    if (open !== "{" && open !== "[") return scalar(end);
    ++at;
    const list: Yaml[] = [];
    const map: { [key: string]: Yaml } = {};
    for (blank(); at < text.length && text[at] !== "}" && text[at] !== "]"; blank()) {
      if (open === "[") {
        list.push(value(/^[,\]]/));
      } else {
        const key = scalar(/^:\s/);
        ++at;
        map[key] = value(/^[,}]/);
      }
      blank();
      if (text[at] === ",") ++at;
    }
    ++at;
    return open === "[" ? list : map;
  };
  return value(/^$/);
}

/** The compiler has checked the file, so what is not understood here is left out. */
export function parsedYaml(text: string): Yaml {
  const lines = text
    .split("\n")
    .map((line) => line.replace(/(^|\s)#.*$/, "").trimEnd())
    .filter((line) => line.trim() !== "");
  const indent = (line: string) => line.length - line.trimStart().length;
  const block = (first: number, last: number): Yaml => {
    const begin = lines[first]!.trim();
    if (!/^[\w"']+\s*:(\s|$)/.test(begin)) {
      if (!begin.startsWith("- ")) return flow(lines.slice(first, last).join(" "));
      return lines.slice(first, last).map((line) => flow(line.trim().slice(2)));
    }
    const map: { [key: string]: Yaml } = {};
    for (let line = first; line < last;) {
      const [, key, rest] = /^\s*([\w"']+)\s*:\s*(.*)$/.exec(lines[line]!) ?? [];
      let next = line + 1;
      while (next < last && indent(lines[next]!) > indent(lines[line]!)) ++next;
      if (key !== undefined) map[key] = rest ? flow([rest, ...lines.slice(line + 1, next)].join(" ")) : next > line + 1 ? block(line + 1, next) : "";
      line = next;
    }
    return map;
  };
  return lines.length === 0 ? {} : block(0, lines.length);
}

export type DeviceType = "actuator" | "switch" | "magazine" | "key" | "rotary_switch" | "handwheel" | "position_switch";

/** What a hand does at a device; `key` is that of devices.yaml. */
export type Control =
  | { kind: "bit"; key: string; path: string }
  /** One of several positions; the first has this number. */
  | { kind: "position"; key: string; path: string; first: number; names: string[] }
  /** A byte that is counted up and down. */
  | { kind: "counter"; key: string; path: string };

export interface Device {
  name: string;
  type: DeviceType;
  controls: Control[];
  /** Inputs and lamps of the device: key and path. */
  shows: { key: string; path: string }[];
}

const types: readonly string[] = ["actuator", "switch", "magazine", "key", "rotary_switch", "handwheel", "position_switch"];
const shown = ["extended", "retracted", "on", "place", "at_place", "lamp", "value", "counter"];
/** Bits that a device reads. Outputs belong to the programs; what is an input or a relay is moved by hand. */
const read = ["extend", "retract", "command", "blocked", "fault", "input"];

export function simulatedDevices(text: string): Device[] {
  const all = parsedYaml(text);
  if (typeof all === "string" || Array.isArray(all)) return [];
  return Object.entries(all).flatMap(([name, description]) => {
    const [type, values] = typeof description === "object" && !Array.isArray(description) ? (Object.entries(description)[0] ?? []) : [];
    if (type === undefined || !types.includes(type) || typeof values !== "object" || Array.isArray(values)) return [];
    const of = (key: string) => (typeof values[key] === "string" ? values[key] : "");
    const path = (key: string) => (/^[A-Z]\d/i.test(of(key)) ? `%${of(key).toUpperCase()}` : of(key));
    const controls: Control[] = read.filter((key) => /^[XR]\d/i.test(of(key))).map((key) => ({ kind: "bit", key, path: path(key) }));
    const list = values["values"];
    if (type === "rotary_switch" && Array.isArray(list)) controls.push({ kind: "position", key: "position", path: path("position"), first: 0, names: list.map(String) });
    if (type === "magazine") {
      const names = Array.from({ length: Number(of("places")) || 0 }, (_, place) => String(place + 1));
      controls.push({ kind: "position", key: "place", path: `simulation.device_${name}.place`, first: 1, names });
    }
    if (type === "handwheel") controls.push({ kind: "counter", key: "turned", path: path("turned") });
    const shows = shown.filter((key) => of(key) !== "").map((key) => ({ key, path: path(key) }));
    return [{ name, type: type as DeviceType, controls, shows }];
  });
}

/** A byte, counted on by `counts`. */
export const counted = (value: string, counts: number): string => String((((Number(value) || 0) + counts) % 256 + 256) % 256);
