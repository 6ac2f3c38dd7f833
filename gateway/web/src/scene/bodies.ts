// SPDX-License-Identifier: Apache-2.0
// The bodies of bodies.yaml for the picture of the machine.
import {
  BoxGeometry, type BufferGeometry, CylinderGeometry, EdgesGeometry, Group, type LineBasicMaterial, LineSegments, type Material, Matrix4,
  Mesh, SphereGeometry, Vector3,
} from "three";
import { ConvexGeometry } from "three/examples/jsm/geometries/ConvexGeometry.js";
import type { MachineBodies, MachineBody } from "../contract";
import { type AxisValues, placements } from "./links";

/** Degrees between two faces from which on their edge is drawn. */
const edge = 30;
const vector = (v: number[]) => new Vector3(v[0], v[1], v[2]);

function geometryOf({ shape, size, points }: MachineBody): BufferGeometry {
  switch (shape) {
    case "box":
      return new BoxGeometry(size[0], size[1], size[2]);
    case "cylinder":
      // That of three.js is about Y.
      return new CylinderGeometry(size[0]! / 2, size[0]! / 2, size[1], 48).rotateX(Math.PI / 2);
    case "sphere":
      return new SphereGeometry(size[0]! / 2, 32, 16);
    default:
      return new ConvexGeometry((points ?? []).map(vector));
  }
}

/** Whether these are drawn in place of the arms and pivots of the chain: a machine's own ones are. */
export const isDrawn = (bodies: MachineBodies | undefined): bodies is MachineBodies =>
  bodies !== undefined && !bodies.derived && bodies.bodies.length > 0;

export class DrawnBodies {
  readonly group = new Group();
  private readonly parts: { mesh: Mesh; body: MachineBody; rest: Matrix4 }[];

  constructor(private readonly machine: MachineBodies, material: (body: MachineBody) => Material, edges: LineBasicMaterial) {
    this.parts = machine.bodies.map((body) => {
      const mesh = new Mesh(geometryOf(body), material(body));
      mesh.name = body.name;
      mesh.matrixAutoUpdate = false;
      mesh.add(new LineSegments(new EdgesGeometry(mesh.geometry, edge), edges));
      this.group.add(mesh);
      const [a, b, c, d, e, f, g, h, i] = body.rotation as [number, number, number, number, number, number, number, number, number];
      const rest = new Matrix4().set(a, b, c, 0, d, e, f, 0, g, h, i, 0, 0, 0, 0, 1).setPosition(vector(body.position));
      return { mesh, body, rest };
    });
  }

  /**
   * Puts every body where it is with the axes at `value`. `worldFromWorkpiece`: from the frame of the workpiece to that
   * of the picture. `ownTool`: the tool in the spindle is one of the tool table, which is drawn by itself.
   */
  place(value: AxisValues, worldFromWorkpiece: Matrix4, ownTool: boolean): void {
    const sides = { workpiece: placements(this.machine.workpiece_side, value), tool: placements(this.machine.tool_side, value) };
    const base = sides.workpiece[sides.workpiece.length - 1]!.clone().invert().premultiply(worldFromWorkpiece);
    for (const { mesh, body, rest } of this.parts) {
      mesh.matrix.copy(base).multiply(sides[body.side][body.depth]!).multiply(rest);
      mesh.matrixWorldNeedsUpdate = true;
      mesh.visible = !(body.tool && ownTool);
    }
  }
}
