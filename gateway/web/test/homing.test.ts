// SPDX-License-Identifier: Apache-2.0
import { afterEach, expect, test, vi } from "vitest";
import { callsHomingProgram, homingBy, homingLine, homingOrder, readHomingWay } from "../src/state/homing";

afterEach(() => void vi.unstubAllGlobals());

const named = (...names: string[]) => names.map((name) => ({ name }));

test("all axes are homed by one line, in the order of the channel and in its dialect", () => {
  expect(homingOrder("XYZABCUVW")).toEqual(["X", "Y", "Z", "U", "V", "W", "A", "B", "C"]);
  expect(homingLine({ program: false, num: false }, "XYZAC")).toBe("G28.2 X0 Y0 Z0 A0 C0");
  expect(homingLine({ program: false, num: true }, "XZW")).toBe("G159 X Z W");
  expect(homingLine({ program: false, num: false, named: true }, "XZ")).toBe("(DIALECT: ISO) G28.2 X0 Z0");
  expect(homingBy({ program: false, num: true }, "XZCW")).toBe("X Z W C");
});

test("the program of the machine's builder goes before that", () => {
  expect(homingLine({ program: true, num: false }, "XYZ")).toBe("M98 P9990");
  expect(homingLine({ program: true, num: true }, "XYZ")).toBe("G77 H9990");
  expect(homingLine({ program: true, num: false, named: true }, "XYZ")).toBe("(DIALECT: ISO) M98 P9990");
  expect(homingBy({ program: true, num: false }, "XYZ")).toBe("O9990");
});

test("O9990 is the program that the channel finds under this name", () => {
  expect(callsHomingProgram(named("O0001.nc", "O9990", "part.nc"))).toBe(true);
  expect(callsHomingProgram(named("O9990.nc"))).toBe(true);
  expect(callsHomingProgram(named("O9990.nc.txt", "O99901"))).toBe(true);
  for (const other of ["9990.nc", "o9990", "O99901", "O9990x.nc", "PO9990"]) expect(callsHomingProgram(named(other)), other).toBe(false);
});

// It homes the axis that L0 names, and L0 is none here.
test("a stored 9990.9 is never run in its place", () => {
  expect(callsHomingProgram(named("O9990.9"))).toBe(false);
  expect(callsHomingProgram(named("O9990.9.nc"))).toBe(false);
  expect(callsHomingProgram(named("O9990.9", "O9990.nc"))).toBe(true);
  expect(callsHomingProgram(named("O9990", "O9990.9"))).toBe(true);
});

test("what the gateway does not say is not guessed", async () => {
  const answers: Record<string, object> = {
    "/api/programs": { set: 0, revision: 1, programs: named("O9990") },
    "/api/parameters/41959": { number: 41959, value: 1 },
    "/api/parameters/42959": { number: 42959, value: 3 },
  };
  vi.stubGlobal("fetch", (path: string) => {
    const body = answers[path];
    return Promise.resolve(new Response(JSON.stringify(body ?? {}), { status: body ? 200 : 504 }));
  });
  expect(await readHomingWay(1)).toEqual({ program: true, num: true });
  expect(await readHomingWay(2)).toEqual({ program: true, num: false, named: true });
  expect(await readHomingWay(0)).toBeNull();
  delete answers["/api/programs"];
  expect(await readHomingWay(1)).toBeNull();
});
