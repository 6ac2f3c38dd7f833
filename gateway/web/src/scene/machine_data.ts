// SPDX-License-Identifier: Apache-2.0
// What the 3D view draws besides the positions, read from the gateway: chain, travel, tools, workpiece zero.
import { get, type Parameter, type Tool, type WorkOffset } from "../api";
import type { MachineBodies } from "../contract";
import type { Channel } from "../state/model";
import { Chain, type Vector } from "./chain";

export interface MachineData {
  chain: Chain;
  /** Machine coordinates of X, Y, Z; mm. An axis that the channel does not have is at zero. */
  travel: { low: Vector; high: Vector };
  tools: Map<number, Tool>;
  offsets: WorkOffset[];
  /** Seconds of an interpolation cycle. */
  period: number;
  /** Undefined when they cannot be read, as with an error in bodies.yaml. */
  bodies: MachineBodies | undefined;
}

const channelBase = (channel: number) => 40000 + 1000 * channel;
const travelOffset = { high: 6, low: 7 };

/** Undefined when the parameters cannot be read. */
export async function readMachine(channel: Channel): Promise<MachineData | undefined> {
  const [parameters, tools, offsets, period, bodies] = await Promise.all([
    get<{ parameters: Parameter[] }>("/api/parameters?class=channel&limit=10000"),
    get<{ tools: Tool[] }>("/api/tools"),
    get<{ offsets: WorkOffset[] }>("/api/work-offsets"),
    get<Parameter>("/api/parameters/1"),
    get<MachineBodies>(`/api/bodies/${channel.channel}`),
  ]);
  if (!parameters.ok || !parameters.body) return undefined;
  const base = channelBase(channel.channel);
  const values = new Map(parameters.body.parameters.map((one) => [one.number - base, Number(one.value)]));
  const limit = async (letter: string, offset: number) => {
    const axis = channel.axes[channel.letters.indexOf(letter)];
    if (axis === undefined) return 0;
    const answer = await get<Parameter>(`/api/parameters/${100000 + 1000 * axis + offset}`);
    return Number(answer.body?.value ?? 0);
  };
  const limits = (offset: number) => Promise.all(["X", "Y", "Z"].map((letter) => limit(letter, offset))) as Promise<Vector>;
  const [low, high] = await Promise.all([limits(travelOffset.low), limits(travelOffset.high)]);
  return {
    chain: new Chain((offset) => values.get(offset) ?? 0),
    travel: { low, high },
    tools: new Map((tools.body?.tools ?? []).map((tool) => [tool.number, tool])),
    offsets: offsets.body?.offsets ?? [],
    period: Number(period.body?.value ?? 1000) / 1e6,
    bodies: bodies.ok ? bodies.body : undefined,
  };
}

/** mm from the spindle face to the tip, wear included; 0 without a tool. */
export function toolLength(data: MachineData, number: number): number {
  const tool = data.tools.get(number);
  return tool ? tool.length + tool.length_wear : 0;
}
