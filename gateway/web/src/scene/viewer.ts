// SPDX-License-Identifier: Apache-2.0
// The picture of the machine. It is loaded when the operator opens the view, draws only when something has changed, and
// not at all while the tab is hidden. Lengths in mm; Z is up.
import {
  AxesHelper, Box3, BoxGeometry, BufferAttribute, BufferGeometry, Color, ColorManagement, CylinderGeometry, DirectionalLight, DoubleSide,
  EdgesGeometry, Group, HemisphereLight, LinearSRGBColorSpace, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshLambertMaterial,
  type Object3D, OrthographicCamera, Quaternion, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { PlannedPath } from "../contract";
import type { Channel } from "../state/model";
import type { History } from "../state/history";
import { externalOffset } from "../state/work_zero";
import { DrawnBodies, isDrawn } from "./bodies";
import type { Angles, Vector } from "./chain";
import { type MachineData, toolLength } from "./machine_data";
import { PathBuffer } from "./path";
import type { Standpoint } from "./standpoint";

export type FixedView = "front" | "right" | "top" | "space";
export type Layer = "machine" | "travel" | "programmed" | "path";

/** What a drawn path may be beside the executed one, in pixels. */
const finePixels = 0.4;
const mostWhileTurning = 12_000;
const directionOf: Record<FixedView, Vector> = { front: [0, -1, 0], right: [1, 0, 0], top: [0, -1e-4, 1], space: [0.8, -1, 0.75] };
const up = new Vector3(0, 1, 0);
const vector = (v: Vector) => new Vector3(...v);
const components = ({ x, y, z }: Vector3): Vector => [x, y, z];

/** Of each letter A B C U V W, in degrees. */
function anglesOf(channel: Channel): Angles {
  return [..."ABCUVW"].map((letter) => channel.machine[channel.letters.indexOf(letter)] ?? 0);
}

function positionOf(channel: Channel): Vector {
  return [..."XYZ"].map((letter) => channel.machine[channel.letters.indexOf(letter)] ?? 0) as Vector;
}

/** A cylinder between two points; invisible when they are the same. */
function spanCylinder(mesh: Mesh, from: Vector3, to: Vector3, radius: number): void {
  const along = to.clone().sub(from);
  const length = along.length();
  mesh.visible = length > 1e-6;
  if (!mesh.visible) return;
  mesh.position.copy(from).addScaledVector(along, 0.5);
  mesh.quaternion.setFromUnitVectors(up, along.divideScalar(length));
  mesh.scale.set(radius, length, radius);
}

export class Viewer {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
  private readonly controls: OrbitControls;
  private readonly path = new PathBuffer();
  private readonly pathLines: LineSegments;
  private readonly programmed: LineSegments;
  private readonly workpiece = new Group();
  private readonly machine = new Group();
  private readonly travel: LineSegments;
  private readonly zero: Object3D;
  private readonly part = new CylinderGeometry(1, 1, 1, 32);
  private readonly tool: Mesh;
  /** Of bodies.yaml; in place of what is drawn from the chain: arms, pivots, tables. */
  private readonly bodies: DrawnBodies | undefined;
  private readonly arms: Mesh[] = [];
  private readonly pivots: Mesh[] = [];
  private readonly tables: Mesh[] = [];
  private readonly resize: ResizeObserver;
  private readonly materials: Record<"body" | "pivot" | "table" | "tool", MeshLambertMaterial>;
  private readonly edges = new LineBasicMaterial({ transparent: true, opacity: 0.7 });
  private uploaded = 0;
  private simplifiedFor = 0;
  private turning = false;
  private pixels = finePixels;
  private asked = 0;
  private size = 100;
  private following = false;
  /** What fills the picture; undefined when the operator has moved it. */
  private fitted: { whole: boolean } | undefined;
  /** Called when the operator has turned, moved or zoomed the picture. */
  onMoved: () => void = () => undefined;
  private latest: { channel: Channel; history: History } | undefined;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly data: MachineData) {
    this.renderer = new WebGLRenderer({ canvas, antialias: window.devicePixelRatio < 2 && !navigator.webdriver, alpha: true });
    // Colours are those of the page, as they are.
    ColorManagement.enabled = false;
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    const material = () => new MeshLambertMaterial({ side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    this.materials = { body: material(), pivot: material(), table: material(), tool: material() };
    this.materials.table.transparent = true;
    this.materials.table.opacity = 0.55;

    const light = new DirectionalLight(0xffffff, 1.5);
    light.position.set(0.5, -1, 1.4);
    this.scene.add(new HemisphereLight(0xffffff, 0xaab4bd, 1.8), light);

    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.path.points, 3));
    geometry.setAttribute("color", new BufferAttribute(this.path.colours, 4, true));
    geometry.setIndex(new BufferAttribute(this.path.drawn, 1));
    this.pathLines = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true }));
    this.pathLines.frustumCulled = false;
    this.programmed = new LineSegments(new BufferGeometry(), [new LineBasicMaterial(), new LineBasicMaterial({ transparent: true, opacity: 0.35 })]);
    this.programmed.frustumCulled = false;

    const { low, high } = data.travel;
    const extent = new Vector3().subVectors(vector(high), vector(low));
    this.size = Math.max(50, Math.min(...[extent.x, extent.y, extent.z].filter((side) => side > 0), 2000));
    const box = new BoxGeometry(Math.max(extent.x, 1), Math.max(extent.y, 1), Math.max(extent.z, 1));
    this.travel = new LineSegments(new EdgesGeometry(box), new LineBasicMaterial());
    this.zero = new AxesHelper(this.size / 5);
    this.zero.renderOrder = 1;
    this.workpiece.matrixAutoUpdate = false;
    this.workpiece.add(this.programmed, this.pathLines, this.zero);

    const mesh = (which: keyof Viewer["materials"]) => {
      const made = new Mesh(this.part, this.materials[which]);
      this.machine.add(made);
      return made;
    };
    this.tool = mesh("tool");
    if (isDrawn(data.bodies)) {
      // The tool and the path are seen through the spindle.
      this.materials.body.transparent = true;
      this.materials.body.opacity = 0.4;
      this.bodies = new DrawnBodies(data.bodies, ({ side, tool }) => this.materials[tool ? "tool" : side === "tool" ? "body" : "table"], this.edges);
      this.machine.add(this.bodies.group);
      this.canvas.dataset.bodies = String(data.bodies.bodies.length);
    } else {
      const still: Angles = [0, 0, 0, 0, 0, 0];
      const head = data.chain.headAt([0, 0, 0], still, 0);
      for (let i = 0; i <= head.pivots.length; ++i) this.arms.push(mesh("body"));
      for (let i = 0; i < head.pivots.length; ++i) this.pivots.push(mesh("pivot"));
      for (let i = 0; i < Math.max(1, data.chain.tablePivots(still).length); ++i) this.tables.push(mesh("table"));
    }
    this.scene.add(this.workpiece, this.machine, this.travel);

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.listenToKeyEvents(canvas);
    this.camera.up.set(0, 0, 1);
    let before = "";
    this.controls.addEventListener("start", () => {
      before = JSON.stringify(this.standpoint);
      this.turn(true);
    });
    this.controls.addEventListener("end", () => {
      this.turn(false);
      // A click, after which the arrow keys move the picture, has not moved it yet.
      if (JSON.stringify(this.standpoint) !== before) this.moved();
    });
    this.controls.addEventListener("change", () => {
      if (this.camera.zoom > 1.4 * this.simplifiedFor || this.camera.zoom < this.simplifiedFor / 2) this.simplify();
      this.ask();
    });
    this.resize = new ResizeObserver(() => this.measure());
    this.resize.observe(canvas);
    document.addEventListener("visibilitychange", this.ask);
    this.look("space");
    this.measure();
  }

  /** Colours from the page's theme; `colour` gives the value of a name of style.css. */
  paint(colour: (name: string) => string): void {
    const set = (material: MeshLambertMaterial, name: string) => material.color.set(new Color(colour(name)));
    set(this.materials.body, "dim");
    set(this.materials.pivot, "accent");
    set(this.materials.table, "pressed-line");
    set(this.materials.tool, "warn");
    for (const material of this.programmed.material as LineBasicMaterial[]) material.color.set(new Color(colour("accent")));
    this.edges.color.set(new Color(colour("text")));
    (this.travel.material as LineBasicMaterial).color.set(new Color(colour("dim")));
    this.ask();
  }

  /** Shows a new state; only what changed since the last one is computed. */
  update(channel: Channel, history: History): void {
    this.latest = { channel, history };
    this.pose(channel);
    const change = this.path.update(history, {
      chain: this.data.chain, toolLength: (tool) => toolLength(this.data, tool), period: this.data.period,
    });
    this.upload(change);
    this.canvas.dataset.segments = String(this.path.segments);
    this.ask();
  }

  /** The path that a program will take; `zero`: G54 of X Y Z, which its points count from. */
  program(path: PlannedPath | undefined, zero: Vector): void {
    const count = path?.x.length ?? 0;
    const points = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i) [path!.x, path!.y, path!.z].forEach((column, axis) => (points[3 * i + axis] = column[i]! + zero[axis]!));
    const pairs = (rapid: boolean) => Array.from({ length: Math.max(0, count - 1) }, (_, i) => i).filter((i) => path!.rapid[i + 1] === rapid).flatMap((i) => [i, i + 1]);
    const [feeds, rapids] = [pairs(false), pairs(true)];
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(points, 3));
    geometry.setIndex([...feeds, ...rapids]);
    geometry.addGroup(0, feeds.length, 0);
    geometry.addGroup(feeds.length, rapids.length, 1);
    this.programmed.geometry.dispose();
    this.programmed.geometry = geometry;
    this.canvas.dataset.programmed = String(Math.max(0, count - 1));
    this.ask();
  }

  get segments(): number {
    return this.path.segments;
  }
  /** mm/min of the colour at the end of the scale. */
  get scale(): number {
    return this.path.scale;
  }

  show(layer: Layer, on: boolean): void {
    ({ machine: this.machine, travel: this.travel, programmed: this.programmed, path: this.pathLines } as Record<Layer, Object3D>)[layer].visible = on;
    this.ask();
  }

  follow(on: boolean): void {
    this.following = on;
    if (this.latest) this.pose(this.latest.channel);
    this.ask();
  }

  look(view: FixedView): void {
    this.camera.position.copy(this.controls.target).addScaledVector(vector(directionOf[view]).normalize(), 1000);
    this.controls.update();
    this.fit();
  }

  get standpoint(): Standpoint {
    return { position: components(this.camera.position), target: components(this.controls.target), zoom: this.camera.zoom };
  }

  stand({ position, target, zoom }: Standpoint): void {
    this.fitted = undefined;
    this.camera.position.fromArray(position);
    this.controls.target.fromArray(target);
    this.camera.lookAt(this.controls.target);
    this.camera.zoom = zoom;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.simplify();
    this.ask();
  }

  /** The operator has turned, moved or zoomed the picture. */
  moved(): void {
    this.fitted = undefined;
    this.onMoved();
  }

  /** What fills the picture has changed, or the size of the picture. */
  refit(): void {
    if (this.fitted) this.fit(this.fitted.whole);
  }

  /** The executed path fills the picture, before it the programmed one; with `whole`, and without a path, the machine with both. */
  fit(whole = false): void {
    this.fitted = { whole };
    this.scene.updateMatrixWorld();
    const box = this.pathBox(whole);
    if (whole || box.isEmpty()) box.union(this.machineBox());
    const centre = box.getCenter(new Vector3());
    this.camera.position.add(centre.clone().sub(this.controls.target));
    this.controls.target.copy(centre);
    this.camera.lookAt(centre);
    this.camera.updateMatrixWorld();
    const inverse = this.camera.matrixWorldInverse;
    const seen = box.clone().applyMatrix4(inverse);
    const size = seen.getSize(new Vector3());
    const [width, height] = [this.camera.right - this.camera.left, this.camera.top - this.camera.bottom];
    this.camera.zoom = 0.9 * Math.min(width / Math.max(size.x, 1e-3), height / Math.max(size.y, 1e-3));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.simplify();
    this.ask();
  }

  /** Of the executed path, before it of the programmed one, or of both; empty without any. */
  private pathBox(both: boolean): Box3 {
    const box = new Box3();
    const { points, count, segments } = this.path;
    const point = new Vector3();
    if (segments > 0) for (let i = 0; i < count; ++i) box.expandByPoint(point.fromArray(points, 3 * i).applyMatrix4(this.workpiece.matrixWorld));
    const programmed = this.programmed.geometry.getAttribute("position");
    if ((both || box.isEmpty()) && programmed?.count > 1)
      box.union(new Box3().setFromBufferAttribute(programmed as BufferAttribute).applyMatrix4(this.workpiece.matrixWorld));
    return box.isEmpty() ? box : box.expandByScalar(this.size / 20);
  }

  /** Of the machine and the workpiece zero. */
  private machineBox(): Box3 {
    const box = new Box3().setFromObject(this.bodies?.group ?? this.machine);
    if (!this.bodies) box.expandByObject(this.travel);
    return box.expandByPoint(this.zero.getWorldPosition(new Vector3()));
  }

  dispose(): void {
    cancelAnimationFrame(this.asked);
    document.removeEventListener("visibilitychange", this.ask);
    this.resize.disconnect();
    this.controls.dispose();
    this.scene.traverse((object) => {
      if (object instanceof Mesh || object instanceof LineSegments) (object.geometry as BufferGeometry).dispose();
    });
    this.renderer.dispose();
  }

  private pose(channel: Channel): void {
    const { chain, travel, tools, offsets } = this.data;
    const angles = anglesOf(channel);
    const tool = tools.get(channel.tool);
    const head = chain.headAt(positionOf(channel), angles, toolLength(this.data, channel.tool));
    const radius = this.size / 16;
    const points = [head.face, ...head.pivots.map((pivot) => pivot.position), head.ram].map(vector);
    this.arms.forEach((arm, i) => {
      // The last part is the ram, which is drawn as a piece along the tool's rest direction.
      const to = i + 1 < points.length - 1 ? points[i + 1]! : points[points.length - 1]!.clone();
      if (i === this.arms.length - 1) to.z += this.size / 3;
      spanCylinder(arm, points[i]!, to, radius * (1 + 0.35 * i));
    });
    this.pivots.forEach((mesh, i) => {
      const { position, direction } = head.pivots[i]!;
      const axis = vector(direction).multiplyScalar(radius * 2.2);
      spanCylinder(mesh, vector(position).sub(axis), vector(position).add(axis), radius * 0.7);
    });
    const cutting = tool ? Math.max(tool.radius + tool.radius_wear, 0.5) : 0.5;
    spanCylinder(this.tool, vector(head.tip), vector(head.face), cutting);

    this.workpiece.matrix.copy(this.matrixOf(angles));
    const value = (letter: string) => channel.machine[channel.letters.indexOf(letter)] ?? 0;
    this.bodies?.place(value, this.workpiece.matrix, tool !== undefined);
    const pivots = chain.tablePivots(angles);
    this.tables.forEach((mesh, i) => {
      const pivot = pivots[i];
      if (!pivot) {
        // A machine without a rotary table has a plate at the bottom of the travel.
        const bottom = new Vector3((travel.low[0] + travel.high[0]) / 2, (travel.low[1] + travel.high[1]) / 2, travel.low[2]);
        spanCylinder(mesh, bottom.clone().setZ(bottom.z - radius), bottom, this.size * 0.6);
      } else if (i === 0) {
        const direction = vector(pivot.direction);
        if (direction.dot(vector(this.upOfTable(angles))) < 0) direction.negate();
        const top = vector(pivot.position);
        spanCylinder(mesh, top.clone().addScaledVector(direction, -radius), top, this.size * 0.33);
      } else {
        const axis = vector(pivot.direction).multiplyScalar(this.size * 0.45);
        spanCylinder(mesh, vector(pivot.position).sub(axis), vector(pivot.position).add(axis), radius * 0.6);
      }
    });

    const offset = (index: number) => offsets.find((one) => one.channel === channel.channel && one.index === index)?.values ?? [];
    const active = offset(channel.work_offset), external = offset(externalOffset);
    const zero = [0, 1, 2].map((axis) => (active[axis] ?? 0) + (external[axis] ?? 0)) as Vector;
    this.zero.position.set(...zero);
    const tip = vector(head.tip);
    // The travel is that of the axes; drawn for the tip, so that the tip touches the box where an axis ends.
    const [x, y, z] = chain.directions(angles) as [Vector, Vector, Vector];
    const middle = travel.low.map((low, i) => (low + travel.high[i]!) / 2 - positionOf(channel)[i]!) as Vector;
    const basis = new Matrix4().makeBasis(vector(x), vector(y), vector(z));
    this.travel.position.copy(tip).add(vector(middle).applyMatrix4(basis));
    this.travel.quaternion.copy(new Quaternion().setFromRotationMatrix(basis));
    if (this.following) {
      this.camera.position.add(tip.clone().sub(this.controls.target));
      this.controls.target.copy(tip);
      this.controls.update();
    }
  }

  /** From the frame of the workpiece to the world. */
  private matrixOf(angles: Angles): Matrix4 {
    const { chain } = this.data;
    const origin = vector(chain.worldFromWorkpiece([0, 0, 0], angles));
    const axes = ([[1, 0, 0], [0, 1, 0], [0, 0, 1]] as Vector[]).map((v) => vector(chain.worldFromWorkpiece(v, angles)).sub(origin));
    return new Matrix4().makeBasis(axes[0]!, axes[1]!, axes[2]!).setPosition(origin);
  }

  private upOfTable(angles: Angles): Vector {
    const turned = new Vector3(0, 0, 1).transformDirection(this.matrixOf(angles));
    return [turned.x, turned.y, turned.z];
  }

  private upload(change: ReturnType<PathBuffer["update"]>): void {
    if (change === "none") return;
    const geometry = this.pathLines.geometry;
    const { count } = this.path;
    const first = change === "all" ? 0 : this.uploaded;
    const send = (attribute: BufferAttribute, from: number, to: number) => {
      // A frame may take several changes at once, so ranges add up until they were sent.
      if (change === "all") attribute.clearUpdateRanges();
      if (to > from) attribute.addUpdateRange(from, to - from);
      attribute.needsUpdate = true;
    };
    send(geometry.getAttribute("position") as BufferAttribute, 3 * first, 3 * count);
    send(geometry.getAttribute("color") as BufferAttribute, 4 * first, 4 * count);
    this.uploaded = count;
    this.simplify();
  }

  /** Leaves out of the path what is less than a fraction of a pixel at this zoom; more while the operator turns it. */
  private simplify(): void {
    const { zoom } = this.camera;
    if (zoom > 1.4 * this.simplifiedFor || zoom < this.simplifiedFor / 2) this.simplifiedFor = zoom;
    let from = this.path.simplify(this.pixels / this.simplifiedFor);
    // While it turns the picture must be fluent: rather coarse than late.
    while (this.turning && this.path.drawnSegments > mostWhileTurning && this.pixels < 8) {
      this.pixels *= 2;
      from = this.path.simplify(this.pixels / this.simplifiedFor);
    }
    const geometry = this.pathLines.geometry;
    const index = geometry.getIndex()!;
    const count = this.path.drawnSegments;
    if (from === 0) index.clearUpdateRanges();
    if (count > from) index.addUpdateRange(2 * from, 2 * (count - from));
    index.needsUpdate = true;
    geometry.setDrawRange(0, 2 * count);
    this.canvas.dataset.drawn = String(count);
  }

  private turn(on: boolean): void {
    this.turning = on;
    this.pixels = on ? 1.2 : finePixels;
    this.simplify();
    this.ask();
  }

  private measure(): void {
    const [width, height] = [Math.max(1, this.canvas.clientWidth), Math.max(1, this.canvas.clientHeight)];
    this.renderer.setSize(width, height, false);
    this.camera.left = -width / 2;
    this.camera.right = width / 2;
    this.camera.top = height / 2;
    this.camera.bottom = -height / 2;
    this.camera.updateProjectionMatrix();
    this.refit();
    this.ask();
  }

  private readonly ask = (): void => {
    if (document.hidden || this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.renderer.render(this.scene, this.camera);
      const { position, target, zoom } = this.standpoint;
      this.canvas.dataset.standpoint = [...position, ...target, zoom].join();
      this.canvas.dataset.frames = String(Number(this.canvas.dataset.frames ?? 0) + 1);
    });
  };
}
