// SPDX-License-Identifier: Apache-2.0
// The executed path as arrays that a graphics card takes: points in the frame of the workpiece, a colour for each by the
// speed that leads to it, and pairs of indices for the segments. Rows that were taken once are not computed again. What is
// drawn leaves out points that make no visible difference.
import { type History, pathCapacity, pathColumns } from "../state/history";
import type { Chain } from "./chain";

export interface PathSource {
  chain: Chain;
  /** mm, of a tool number. */
  toolLength: (tool: number) => number;
  /** Seconds of one cycle. */
  period: number;
}

/** The next of 1, 2, 5, 10, 20 ... that is not below the value. */
export function niceAbove(value: number): number {
  const decade = 10 ** Math.floor(Math.log10(Math.max(value, 1e-9)));
  return ([1, 2, 5, 10].find((factor) => factor * decade >= value * (1 - 1e-9)) ?? 10) * decade;
}

const stops: [number, number, number][] = [[50, 90, 255], [30, 190, 230], [70, 210, 90], [250, 200, 40], [255, 70, 60]];

/** Blue, cyan, green, yellow, red for 0 to 1. */
export function speedColour(fraction: number): [number, number, number] {
  const at = Math.min(1, Math.max(0, fraction)) * (stops.length - 1);
  const low = Math.min(stops.length - 2, Math.floor(at));
  return stops[low]!.map((value, i) => Math.round(value + (at - low) * (stops[low + 1]![i]! - value))) as [number, number, number];
}

/** What is new after update(): nothing, points at the end, or everything. */
export type Change = { from: number } | "none" | "all";

export class PathBuffer {
  readonly points: Float32Array;
  /** Four bytes each: graphics cards read no three. */
  readonly colours: Uint8Array;
  readonly indices: Uint32Array;
  readonly speeds: Float32Array;
  count = 0;
  segments = 0;
  /** mm/min of the last colour. */
  scale = 1000;
  /** Pairs of points to draw, within `tolerance` of the path; the last pair grows. */
  readonly drawn: Uint32Array;
  drawnSegments = 0;
  private tolerance = -1;
  /** Segments that `drawn` already covers. */
  private reduced = 0;
  private anchor = -1;
  private end = -1;
  private direction: [number, number, number] | undefined;
  private reach = 0;
  private taken = 0;
  private cleared = -1;

  /** Keeps at least the newest `kept` points. */
  constructor(private readonly kept = pathCapacity) {
    // A quarter more, so that old points need not be dropped with every new one.
    const capacity = kept + (kept >> 2);
    this.points = new Float32Array(3 * capacity);
    this.colours = new Uint8Array(4 * capacity).fill(255);
    this.indices = new Uint32Array(2 * capacity);
    this.drawn = new Uint32Array(2 * capacity);
    this.speeds = new Float32Array(capacity);
  }

  /** Starts again with the next update, for example after a change of the chain. */
  reset(): void {
    this.cleared = -1;
  }

  /** Takes the new rows of the history. */
  update(history: History, source: PathSource): Change {
    const { path } = history;
    let all = false;
    if (this.cleared !== history.cleared) {
      this.cleared = history.cleared;
      this.count = this.segments = 0;
      this.restart(-1);
      this.scale = 1000;
      this.taken = path.pushed - path.length;
      all = true;
    }
    const fresh = Math.min(path.length, path.pushed - this.taken);
    if (fresh === 0) return all ? "all" : "none";
    if (this.count + fresh > this.speeds.length) {
      this.drop(Math.min(this.count, this.count + fresh - this.kept));
      all = true;
    }
    const from = this.count;
    const before = this.scale;
    for (let row = path.length - fresh; row < path.length; ++row) this.take(history, row, source);
    this.taken = path.pushed;
    if (this.scale !== before) {
      for (let i = 0; i < this.count; ++i) this.paint(i);
      all = true;
    }
    return all ? "all" : { from };
  }

  /**
   * Leaves out points that are within `tolerance` (mm) of a straight line through the points around them (strips, after
   * Reumann and Witkam, 1974). Gives the first pair of `drawn` that has changed.
   */
  simplify(tolerance: number): number {
    if (tolerance !== this.tolerance || this.reduced > this.segments) this.restart(tolerance);
    const from = Math.max(0, this.drawnSegments - 1);
    const pending = this.reduced > 0;
    if (pending) this.drawnSegments -= 1;
    for (let segment = this.reduced; segment < this.segments; ++segment) {
      const first = this.indices[2 * segment]!;
      if (first !== this.end) {
        this.emit();
        this.anchor = first;
        this.direction = undefined;
      }
      this.extend(first + 1, first, tolerance);
      this.end = first + 1;
    }
    this.reduced = this.segments;
    if (this.segments > 0) this.emit();
    return from;
  }

  private restart(tolerance: number): void {
    this.tolerance = tolerance;
    this.reduced = this.drawnSegments = 0;
    this.anchor = this.end = -1;
    this.direction = undefined;
  }

  private emit(): void {
    if (this.end < 0) return;
    this.drawn[2 * this.drawnSegments] = this.anchor;
    this.drawn[2 * this.drawnSegments + 1] = this.end;
    this.drawnSegments += 1;
  }

  /** Takes a point into the strip, or ends the strip at the point before it and begins another. */
  private extend(point: number, before: number, tolerance: number): void {
    const { points } = this;
    for (let attempt = 0; attempt < 2; ++attempt) {
      const [x, y, z] = [0, 1, 2].map((axis) => points[3 * point + axis]! - points[3 * this.anchor + axis]!) as [number, number, number];
      const length = Math.hypot(x, y, z);
      if (!this.direction) {
        if (length > tolerance) {
          this.direction = [x / length, y / length, z / length];
          this.reach = length;
        }
        return;
      }
      const along = x * this.direction[0] + y * this.direction[1] + z * this.direction[2];
      const across = Math.sqrt(Math.max(0, length * length - along * along));
      if (across <= tolerance && along >= this.reach - tolerance) {
        this.reach = Math.max(this.reach, along);
        return;
      }
      this.end = before;
      this.emit();
      this.anchor = before;
      this.direction = undefined;
    }
  }

  private take(history: History, row: number, { chain, toolLength, period }: PathSource): void {
    const { path } = history;
    const at = (column: number) => path.at(row, column);
    const angles = [3, 4, 5, 6, 7, 8].map(at);
    const tip = chain.tipInWorkpiece([at(0), at(1), at(2)], angles, toolLength(at(pathColumns.tool)));
    const i = this.count++;
    this.points.set(tip, 3 * i);
    const joined = i > 0 && at(pathColumns.gap) === 0;
    if (joined) {
      const length = Math.hypot(...tip.map((value, axis) => value - this.points[3 * (i - 1) + axis]!));
      this.speeds[i] = (length / Math.max(period * at(pathColumns.cycles), 1e-6)) * 60;
      this.scale = Math.max(this.scale, niceAbove(this.speeds[i]));
      this.indices[2 * this.segments] = i - 1;
      this.indices[2 * this.segments + 1] = i;
      this.segments += 1;
    } else {
      this.speeds[i] = 0;
    }
    this.paint(i);
  }

  private paint(i: number): void {
    this.colours.set(speedColour(this.speeds[i]! / this.scale), 4 * i);
  }

  /** Drops the oldest points. */
  private drop(points: number): void {
    this.points.copyWithin(0, 3 * points, 3 * this.count);
    this.colours.copyWithin(0, 4 * points, 4 * this.count);
    this.speeds.copyWithin(0, points, this.count);
    this.count -= points;
    this.restart(-1);
    let kept = 0;
    for (let segment = 0; segment < this.segments; ++segment) {
      const first = this.indices[2 * segment]! - points;
      if (first < 0) continue;
      this.indices[2 * kept] = first;
      this.indices[2 * kept + 1] = first + 1;
      kept += 1;
    }
    this.segments = kept;
  }
}
