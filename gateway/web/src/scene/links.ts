// SPDX-License-Identifier: Apache-2.0
// Where the parts between the axes of a machine are: as libs/machine/collision/machine_links, for drawing. Lengths in mm, angles
// in degrees.
import { Matrix4, Vector3 } from "three";
import type { CarryingAxis } from "../contract";

/** The value of an axis by its letter; 0 for one that the channel does not have. */
export type AxisValues = (letter: string) => number;

/**
 * Of every depth of a side, from the base outwards: from a point as it is with every axis at zero to where it is, in
 * the frame of the base.
 */
export function placements(side: readonly CarryingAxis[], value: AxisValues): Matrix4[] {
  const placed = [new Matrix4()];
  for (const axis of side) {
    const direction = new Vector3(...(axis.direction as [number, number, number]));
    const motion = new Matrix4();
    if (axis.rotary) {
      const point = new Vector3(...(axis.point as [number, number, number]));
      motion.makeRotationAxis(direction, (value(axis.axis) * Math.PI) / 180);
      motion.setPosition(point.clone().sub(point.clone().applyMatrix4(motion)));
    } else {
      motion.setPosition(direction.multiplyScalar(value(axis.axis)));
    }
    placed.push(placed[placed.length - 1]!.clone().multiply(motion));
  }
  return placed;
}
