// SPDX-License-Identifier: Apache-2.0
// The planes of G68.1: three points each, in parameters 04c500 .. 04c679.

export type Point = [x: number, y: number, z: number];
export type PlanePoints = [origin: Point, onX: Point, onY: Point];

export const planeCount = 20;

/** Number of the first of the nine parameters of a plane, from 1. */
export const planeParameter = (channel: number, plane: number) => 40500 + 1000 * channel + 9 * (plane - 1);

const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Point, b: Point): Point => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a: Point) => Math.hypot(...a);
const unit = (a: Point): Point => a.map((value) => value / length(a)) as Point;

/** Nobody has entered it. */
export const isEmpty = ([a, b, c]: PlanePoints) => length(minus(b, a)) === 0 && length(minus(c, a)) === 0;

/** Directions of X and Z of the plane in the workpiece; undefined when the points are on a line (to 1e-6 mm). */
export function planeAxes([origin, onX, onY]: PlanePoints): { x: Point; z: Point } | undefined {
  const along = minus(onX, origin);
  const normal = cross(along, minus(onY, origin));
  if (length(along) < 1e-6 || length(normal) < 1e-6 * length(along)) return undefined;
  return { x: unit(along), z: unit(normal) };
}
