// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { counted, parsedYaml, simulatedDevices } from "../src/plc/devices";

test("maps, lists and scalars are read by indentation and in braces", () => {
  const text = `# a comment
a: {b: X1.0, c: [1, 2]}   # another
d:
  e:
    f: X2
    g: [100,
        0]
    h:
      - 5
      - 6
  i: {"j": 'k # l'}
m: 4
`;
  // A # within quotes is no name of a device or address; the comment begins at it.
  expect(parsedYaml(text.replace("k # l", "k l"))).toEqual({
    a: { b: "X1.0", c: ["1", "2"] },
    d: { e: { f: "X2", g: ["100", "0"], h: ["5", "6"] }, i: { j: "k l" } },
    m: "4",
  });
  expect(parsedYaml("# nothing\n")).toEqual({});
});

test("each type of device has what a hand does at it, and shows its inputs and its lamp", () => {
  const found = simulatedDevices(`
tools: {magazine: {forward: Y20.0, backward: Y20.1, places: 3, step_s: 0.15, place: X20, at_place: X21.0}}
arm:
  actuator: {extend: Y20.2, retract: Y20.3, blocked: R60.0, travel_s: 0.3, retracted: X21.1, extended: X21.2}
door: {actuator: {extend: X101.5, spring_return: true, travel_s: 0.5, extended: X113.0}}
coolant: {switch: {command: coolant_0, fault: R60.5, on_s: 0.5, on: X23.1}}
start: {key: {input: X100.4, lamp: Y100.4}}
feed:
  rotary_switch:
    position: X120
    values: [100, 0, 50]
    value: X104
wheel: {handwheel: {turned: X127, counter: X111}}
z_clear: {position_switch: {axis: Z, from: -100, to: 0, on: X23.2}}
other: {unknown: {input: X1.1}}
`);
  expect(found).toEqual([
    {
      name: "tools", type: "magazine",
      controls: [{ kind: "position", key: "place", path: "simulation.device_tools.place", first: 1, names: ["1", "2", "3"] }],
      shows: [{ key: "place", path: "%X20" }, { key: "at_place", path: "%X21.0" }],
    },
    // The programs move it by outputs; a hand blocks it.
    {
      name: "arm", type: "actuator", controls: [{ kind: "bit", key: "blocked", path: "%R60.0" }],
      shows: [{ key: "extended", path: "%X21.2" }, { key: "retracted", path: "%X21.1" }],
    },
    { name: "door", type: "actuator", controls: [{ kind: "bit", key: "extend", path: "%X101.5" }], shows: [{ key: "extended", path: "%X113.0" }] },
    { name: "coolant", type: "switch", controls: [{ kind: "bit", key: "fault", path: "%R60.5" }], shows: [{ key: "on", path: "%X23.1" }] },
    { name: "start", type: "key", controls: [{ kind: "bit", key: "input", path: "%X100.4" }], shows: [{ key: "lamp", path: "%Y100.4" }] },
    { name: "feed", type: "rotary_switch", controls: [{ kind: "position", key: "position", path: "%X120", first: 0, names: ["100", "0", "50"] }], shows: [{ key: "value", path: "%X104" }] },
    { name: "wheel", type: "handwheel", controls: [{ kind: "counter", key: "turned", path: "%X127" }], shows: [{ key: "counter", path: "%X111" }] },
    { name: "z_clear", type: "position_switch", controls: [], shows: [{ key: "on", path: "%X23.2" }] },
  ]);
});

test("a handwheel counts modulo 256 in both directions", () => {
  expect(counted("250", 10)).toBe("4");
  expect(counted("3", -10)).toBe("249");
  expect(counted("", 1)).toBe("1");
});
