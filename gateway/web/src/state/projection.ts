// SPDX-License-Identifier: Apache-2.0
// From machine coordinates to the canvas: parallel projections and the scale that shows everything.
export type View = "XY" | "XZ" | "YZ" | "3D";
export interface Rotation {
  /** Degrees about Z. */
  turn: number;
  /** Degrees above the XY plane the observer stands. */
  tilt: number;
}
export type Point2 = [right: number, up: number];

/** Right and up on the screen of a point in mm. */
export function project(view: View, rotation: Rotation, x: number, y: number, z: number): Point2 {
  if (view === "XY") return [x, y];
  if (view === "XZ") return [x, z];
  if (view === "YZ") return [y, z];
  const turn = (rotation.turn * Math.PI) / 180;
  const tilt = (rotation.tilt * Math.PI) / 180;
  const right = x * Math.cos(turn) + y * Math.sin(turn);
  const away = -x * Math.sin(turn) + y * Math.cos(turn);
  return [right, z * Math.cos(tilt) + away * Math.sin(tilt)];
}

export interface Fit {
  scale: number;
  offsetX: number;
  offsetY: number;
}

/** Scale in pixels per mm and the canvas position of the origin; a point alone gets a 10 mm window. */
export function fit(points: Iterable<Point2>, width: number, height: number, margin: number): Fit {
  let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [across, up] of points) {
    left = Math.min(left, across);
    right = Math.max(right, across);
    low = Math.min(low, up);
    high = Math.max(high, up);
  }
  if (left > right) [left, right, low, high] = [0, 0, 0, 0];
  const spanX = Math.max(right - left, 10);
  const spanY = Math.max(high - low, 10);
  const scale = Math.min((width - 2 * margin) / spanX, (height - 2 * margin) / spanY);
  return {
    scale,
    offsetX: width / 2 - ((left + right) / 2) * scale,
    offsetY: height / 2 + ((low + high) / 2) * scale,
  };
}

/** A grid step of 1, 2 or 5 times a power of ten that is at least `pixels` apart. */
export function gridStep(scale: number, pixels: number): number {
  const wanted = pixels / scale;
  const decade = 10 ** Math.floor(Math.log10(wanted));
  return ([1, 2, 5, 10].find((factor) => factor * decade >= wanted * (1 - 1e-9)) ?? 10) * decade;
}
