// SPDX-License-Identifier: Apache-2.0
// The change of the tool from the table: a line of MDI, as an operator types it.
import type { Channel } from "./model";

/** T makes the tool ready, M6 puts it into the spindle. */
export const changeLine = (tool: number) => `T${tool} M6`;

/**
 * Whether the channel is at rest. A held program would be left by the change of the mode to MDI, and could not be
 * continued with another tool in the spindle.
 */
export const mayChange = (one: Pick<Channel, "state" | "suspended">) => one.state === "IDLE" && !one.suspended;
