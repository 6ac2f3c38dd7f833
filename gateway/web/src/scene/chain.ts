// SPDX-License-Identifier: Apache-2.0
// The kinematic chain of a channel for drawing: the formulas of docs/kinematics.md, from the parameters 04c400 .. 04c988
// as the gateway has them. Lengths in mm, angles in degrees. The control itself does not use this.

export type Vector = [x: number, y: number, z: number];
/** Degrees of A, B, C, U, V, W. */
export type Angles = readonly number[];
/** The value of a parameter by its offset in the class of the channel; 0 for one that is not there. */
export type Parameters = (offset: number) => number;

export const add = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a: Vector, factor: number): Vector => [a[0] * factor, a[1] * factor, a[2] * factor];

function normalized(v: Vector): Vector {
  const length = Math.hypot(...v);
  return length > 0 ? scaled(v, 1 / length) : [0, 0, 1];
}

/** Rodrigues' formula: v turned about the unit vector k. */
function turned(k: Vector, degrees: number, v: Vector): Vector {
  const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  const along = (1 - c) * (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]);
  return [
    c * v[0] + s * (k[1] * v[2] - k[2] * v[1]) + along * k[0],
    c * v[1] + s * (k[2] * v[0] - k[0] * v[2]) + along * k[1],
    c * v[2] + s * (k[0] * v[1] - k[1] * v[0]) + along * k[2],
  ];
}

interface Joint {
  direction: Vector;
  offset: Vector;
  /** Index in Angles. */
  angle: number;
}

/** A rotary axis where it is now, in world coordinates. */
export interface Pivot {
  position: Vector;
  direction: Vector;
}

/** The head as it is now, in world coordinates: from the tip over the spindle face and the pivots to the ram. */
export interface Head {
  tip: Vector;
  face: Vector;
  pivots: Pivot[];
  /** Where the head is fixed to the linear axes. */
  ram: Vector;
}

interface Side {
  type: number;
  /** Of the axis next to the tool or the workpiece, then outwards to the base. */
  direction: number[];
  offset: number[];
  correction: number[];
}
const headSide: Side = { type: 410, direction: [414, 411, 920], offset: [420, 417, 923], correction: [969, 972, 975] };
const tableSide: Side = { type: 425, direction: [429, 426, 926], offset: [435, 432, 929], correction: [960, 963, 966] };

function vector(parameters: Parameters, offset: number): Vector {
  return [parameters(offset), parameters(offset + 1), parameters(offset + 2)];
}

function jointsOf(parameters: Parameters, side: Side): Joint[] {
  const joints: Joint[] = [];
  for (let type = parameters(side.type), slot = 0; type > 0 && slot < 3; type = Math.floor(type / 10), ++slot) {
    joints.push({
      direction: normalized(vector(parameters, side.direction[slot]!)),
      offset: add(vector(parameters, side.offset[slot]!), vector(parameters, side.correction[slot]!)),
      angle: Math.min(5, Math.max(0, (type % 10) - 3)),
    });
  }
  return joints;
}

const sum = (joints: Joint[]) => joints.reduce<Vector>((total, joint) => add(total, joint.offset), [0, 0, 0]);

/**
 * World coordinates are those of the machine: with every rotary axis at zero a point of the workpiece is where it is in
 * the frame of the workpiece, and the spindle face is at the machine position.
 */
export class Chain {
  private readonly tool: Vector;
  private readonly head: Joint[];
  private readonly table: Joint[];
  private readonly linear: Vector[];
  private readonly carriers: number[];
  /** Of the ram at machine position zero. */
  private readonly ram: Vector;

  constructor(parameters: Parameters) {
    this.tool = normalized(vector(parameters, 400));
    this.head = jointsOf(parameters, headSide);
    this.table = jointsOf(parameters, tableSide);
    this.linear = [932, 935, 938].map((offset) => normalized(vector(parameters, offset)));
    this.carriers = [905, 906, 907].map(parameters);
    let origin = vector(parameters, 941);
    if (parameters(988) === 1) {
      const correction = (side: Side, count: number) =>
        side.correction.slice(0, count).reduce<Vector>((total, offset) => add(total, vector(parameters, offset)), [0, 0, 0]);
      origin = add(origin, add(vector(parameters, 978), correction(tableSide, this.table.length)));
      origin = subtract(origin, correction(headSide, this.head.length));
    }
    this.ram = add(sum(this.head), origin);
  }

  get hasTable(): boolean {
    return this.table.length > 0;
  }

  /** Directions in which X, Y and Z move the tool. */
  directions(angles: Angles): Vector[] {
    return this.linear.map((direction, axis) => {
      const side = this.carriers[axis]! > 0 ? this.head : this.table;
      const carrying = side.slice(side.length - Math.abs(this.carriers[axis]!));
      return carrying.reduce<Vector>((v, joint) => turned(joint.direction, angles[joint.angle] ?? 0, v), direction);
    });
  }

  /** The ram at a machine position, in world coordinates. */
  private ramAt(machine: Vector, angles: Angles): Vector {
    const [x, y, z] = this.directions(angles) as [Vector, Vector, Vector];
    return add(this.ram, add(scaled(x, machine[0]), add(scaled(y, machine[1]), scaled(z, machine[2]))));
  }

  /** The head with a tool of this length. */
  headAt(machine: Vector, angles: Angles, toolLength: number): Head {
    const ram = this.ramAt(machine, angles);
    // Arms from the tip: to the face, then to each pivot, all turned by the axes between them and the base.
    const arms: Vector[] = [[0, 0, 0], scaled(this.tool, toolLength)];
    const directions: Vector[] = [];
    for (const joint of this.head) {
      const turn = (v: Vector) => turned(joint.direction, angles[joint.angle] ?? 0, v);
      arms.push(add(arms[arms.length - 1]!, joint.offset));
      for (let i = 0; i < arms.length; ++i) arms[i] = turn(arms[i]!);
      for (let i = 0; i < directions.length; ++i) directions[i] = turn(directions[i]!);
      directions.push(joint.direction);
    }
    const tip = subtract(ram, arms[arms.length - 1]!);
    return {
      tip: add(tip, arms[0]!),
      face: add(tip, arms[1]!),
      pivots: directions.map((direction, i) => ({ position: add(tip, arms[i + 2]!), direction })),
      ram,
    };
  }

  /** A point of the workpiece, in world coordinates. */
  worldFromWorkpiece(point: Vector, angles: Angles): Vector {
    const q = this.table.reduce<Vector>((v, joint) => turned(joint.direction, angles[joint.angle] ?? 0, subtract(v, joint.offset)), point);
    return add(q, sum(this.table));
  }

  /** Inverse of worldFromWorkpiece. */
  workpieceFromWorld(point: Vector, angles: Angles): Vector {
    return this.table.reduceRight<Vector>(
      (v, joint) => add(turned(joint.direction, -(angles[joint.angle] ?? 0), v), joint.offset),
      subtract(point, sum(this.table)),
    );
  }

  /** The rotary axes of the table, the one that carries the workpiece first. */
  tablePivots(angles: Angles): Pivot[] {
    return this.table.map((joint, i) => {
      let [position, direction]: [Vector, Vector] = [[0, 0, 0], joint.direction];
      for (const outer of this.table.slice(i + 1)) {
        const turn = (v: Vector) => turned(outer.direction, angles[outer.angle] ?? 0, v);
        position = turn(subtract(position, outer.offset));
        direction = turn(direction);
      }
      return { position: add(position, sum(this.table)), direction };
    });
  }

  /** The tip in the frame of the workpiece. */
  tipInWorkpiece(machine: Vector, angles: Angles, toolLength: number): Vector {
    return this.workpieceFromWorld(this.headAt(machine, angles, toolLength).tip, angles);
  }
}
