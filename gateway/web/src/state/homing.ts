// SPDX-License-Identifier: Apache-2.0
// Homing of all axes of a channel: one line of MDI. The channel carries it out, whatever becomes of the page.
import { get } from "../api";
import type { Parameter, ProgramList } from "../contract";
import { isoHead } from "../program/dialects";

/** The stored program in which the builder of the machine has written the order, as on NUM controls. */
export const homingProgram = "O9990";

/** Parameter 04c959 of a channel, the dialect of its lines. */
export const dialectParameter = (channel: number): number => 40959 + 1000 * channel;
const isoDialect = 0;
const numDialect = 1;

/** How a channel homes all its axes. */
export interface HomingWay {
  /** By O9990; otherwise one axis after the other. */
  program: boolean;
  num: boolean;
  /** The channel reads neither ISO nor NUM, so the line says that it is ISO. */
  named?: boolean;
}

/** The axes as the channel homes them, in whatever order a line names them. */
export const homingOrder = (letters: string): string[] => [..."XYZUVWABC"].filter((letter) => letters.includes(letter));

/**
 * Whether a call of O9990 runs it. The channel takes the program of this name with or without an extension: O9990.nc is
 * O9990. A point and one digit are no extension: O9990.9 is another program of NUM.
 */
export const callsHomingProgram = (programs: readonly { name: string }[]): boolean =>
  programs.some(({ name }) => name === homingProgram || (name.startsWith(`${homingProgram}.`) && !/^\.[1-9](\.|$)/.test(name.slice(homingProgram.length))));

/** For the operator, before anything moves: `O9990`, or `X Y Z`. */
export const homingBy = (way: HomingWay, letters: string): string => (way.program ? homingProgram : homingOrder(letters).join(" "));

/** The line of MDI. */
export function homingLine(way: HomingWay, letters: string): string {
  const head = way.named ? isoHead : "";
  if (way.program) return way.num ? "G77 H9990" : `${head}M98 P9990`;
  const axes = homingOrder(letters);
  return way.num ? `G159 ${axes.join(" ")}` : `${head}G28.2 ${axes.map((axis) => `${axis}0`).join(" ")}`;
}

/** Nothing when the gateway does not say what the channel would do: then nothing may be homed in another order. */
export async function readHomingWay(channel: number): Promise<HomingWay | null> {
  const [listed, dialect] = await Promise.all([
    get<ProgramList>("/api/programs"),
    get<Parameter>(`/api/parameters/${dialectParameter(channel)}`),
  ]);
  if (!listed.ok || !listed.body || !dialect.ok || !dialect.body) return null;
  const value = Number(dialect.body.value);
  const way = { program: callsHomingProgram(listed.body.programs), num: value === numDialect };
  return value === isoDialect || way.num ? way : { ...way, named: true };
}
