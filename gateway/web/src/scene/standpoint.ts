// SPDX-License-Identifier: Apache-2.0
// From where the operator looks at the machine, as the browser keeps it.
import type { Vector } from "./chain";

export interface Standpoint {
  /** mm */
  position: Vector;
  target: Vector;
  /** Pixels of a millimetre. */
  zoom: number;
}

/** Undefined for a text that is none. */
export function standpointOf(stored: string | null): Standpoint | undefined {
  try {
    const { position, target, zoom } = JSON.parse(stored ?? "") as Standpoint;
    const numbers = [...position, ...target, zoom];
    return numbers.length === 7 && numbers.every((one) => Number.isFinite(one)) && zoom > 0 ? { position, target, zoom } : undefined;
  } catch {
    return undefined;
  }
}
