// SPDX-License-Identifier: Apache-2.0
// Homing of all axes of a channel: one line of MDI. The channel carries it out, whatever becomes of the page.
import { get } from "../api";
import type { Parameter, ProgramList } from "../contract";

/** The stored program in which the builder of the machine has written the order, as on NUM controls. */
export const homingProgram = "O9990";

/** Parameter 04c959 of a channel, the dialect of its lines. */
export const dialectParameter = (channel: number): number => 40959 + 1000 * channel;
const numDialect = 1;

/** How a channel homes all its axes. */
export interface HomingWay {
  /** By O9990; otherwise one axis after the other. */
  program: boolean;
  num: boolean;
}

/** The axes as the channel homes them, in whatever order a line names them. */
export const homingOrder = (letters: string): string[] => [..."XYZUVWABC"].filter((letter) => letters.includes(letter));

/**
 * Whether a call of O9990 runs it. The channel takes the first program of the list that has this name before a point,
 * so O9990.nc is O9990, and O9990.9, another program of NUM, would be taken for it.
 */
export function callsHomingProgram(programs: readonly { name: string }[]): boolean {
  const found = programs.find(({ name }) => name === homingProgram || name.startsWith(`${homingProgram}.`));
  return found !== undefined && !/^\.\d/.test(found.name.slice(homingProgram.length));
}

/** For the operator, before anything moves: `O9990`, or `X Y Z`. */
export const homingBy = (way: HomingWay, letters: string): string => (way.program ? homingProgram : homingOrder(letters).join(" "));

/** The line of MDI. */
export function homingLine(way: HomingWay, letters: string): string {
  if (way.program) return way.num ? "G77 H9990" : "M98 P9990";
  const axes = homingOrder(letters);
  return way.num ? `G159 ${axes.join(" ")}` : `G28.2 ${axes.map((axis) => `${axis}0`).join(" ")}`;
}

/** Nothing when the gateway does not say what the channel would do: then nothing may be homed in another order. */
export async function readHomingWay(channel: number): Promise<HomingWay | null> {
  const [listed, dialect] = await Promise.all([
    get<ProgramList>("/api/programs"),
    get<Parameter>(`/api/parameters/${dialectParameter(channel)}`),
  ]);
  if (!listed.ok || !listed.body || !dialect.ok || !dialect.body) return null;
  return { program: callsHomingProgram(listed.body.programs), num: Number(dialect.body.value) === numDialect };
}
