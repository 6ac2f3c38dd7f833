// SPDX-License-Identifier: Apache-2.0
// A recorded path in 3D, coloured by a quantity, with the selected row marked. Z is up, lengths in mm.
import {
  Box3, BufferAttribute, BufferGeometry, Color, ColorManagement, Line, LinearSRGBColorSpace, LineBasicMaterial, Mesh, MeshBasicMaterial,
  OrthographicCamera, Scene, SphereGeometry, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { niceAbove, speedColour } from "./path";

export type FixedView = "front" | "right" | "top" | "space";
const directions: Record<FixedView, [number, number, number]> = { front: [0, -1, 0], right: [1, 0, 0], top: [0, -1e-4, 1], space: [0.8, -1, 0.75] };

/** Points that are drawn: of a longer path evenly spread rows. */
export const mostPoints = 150_000;
/** A pointer that is farther away, in pixels, selects nothing. */
const reach = 24;

export class RecordedPath {
  /** The quantity at the end of the colours. */
  scale = 0;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
  private readonly controls: OrbitControls;
  private readonly resize: ResizeObserver;
  private readonly line = new Line(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true }));
  private readonly mark = new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial());
  private rows = new Uint32Array(0);
  private points = new Float32Array(0);
  private asked = 0;
  private down: [number, number] = [0, 0];

  /** `select` gets the row of the point that was clicked. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly select: (row: number) => void) {
    this.renderer = new WebGLRenderer({ canvas, antialias: window.devicePixelRatio < 2 && !navigator.webdriver, alpha: true });
    ColorManagement.enabled = false;
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.line.frustumCulled = false;
    this.mark.visible = false;
    this.scene.add(this.line, this.mark);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.listenToKeyEvents(canvas);
    this.camera.up.set(0, 0, 1);
    this.controls.addEventListener("change", () => this.ask());
    this.resize = new ResizeObserver(() => this.measure());
    this.resize.observe(canvas);
    canvas.addEventListener("pointerdown", (event) => (this.down = [event.clientX, event.clientY]));
    canvas.addEventListener("pointerup", (event) => {
      if (Math.hypot(event.clientX - this.down[0], event.clientY - this.down[1]) < 4) this.pick(event);
    });
  }

  /** `point` gives the position of a row, `values` the quantity of every row; rows first..last are drawn. */
  set(point: (row: number) => [number, number, number], values: ArrayLike<number>, first: number, last: number): void {
    const count = Math.max(0, Math.min(mostPoints, last - first + 1));
    this.rows = Uint32Array.from({ length: count }, (_, i) => first + Math.floor((i * (last - first)) / Math.max(1, count - 1)));
    this.points = new Float32Array(3 * count);
    const colours = new Uint8Array(3 * count);
    let most = 0;
    for (const row of this.rows) most = Math.max(most, Math.abs(values[row]!) || 0);
    this.scale = niceAbove(Math.max(most, 1e-6));
    this.rows.forEach((row, i) => {
      this.points.set(point(row), 3 * i);
      colours.set(speedColour(Math.abs(values[row]! || 0) / this.scale), 3 * i);
    });
    this.line.geometry.dispose();
    this.line.geometry = new BufferGeometry();
    this.line.geometry.setAttribute("position", new BufferAttribute(this.points, 3));
    this.line.geometry.setAttribute("color", new BufferAttribute(colours, 3, true));
    this.canvas.dataset.points = String(count);
    this.ask();
  }

  /** Marks the point that is drawn nearest to a row. */
  showRow(row: number, colour: string): void {
    const at = this.nearest(row);
    this.mark.visible = at >= 0;
    if (at >= 0) this.mark.position.fromArray(this.points, 3 * at);
    this.mark.material.color.set(new Color(colour));
    this.canvas.dataset.selected = String(row);
    this.ask();
  }

  look(view: FixedView): void {
    this.camera.position.copy(this.controls.target).addScaledVector(new Vector3(...directions[view]).normalize(), 1000);
    this.controls.update();
    this.fit();
  }

  fit(): void {
    const box = new Box3().setFromArray(this.points.length > 0 ? this.points : [0, 0, 0]);
    box.expandByScalar(1);
    const centre = box.getCenter(new Vector3());
    this.camera.position.add(centre.clone().sub(this.controls.target));
    this.controls.target.copy(centre);
    this.camera.lookAt(centre);
    this.camera.updateMatrixWorld();
    const size = box.clone().applyMatrix4(this.camera.matrixWorldInverse).getSize(new Vector3());
    const [width, height] = [this.camera.right - this.camera.left, this.camera.top - this.camera.bottom];
    this.camera.zoom = 0.92 * Math.min(width / Math.max(size.x, 1e-3), height / Math.max(size.y, 1e-3));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.ask();
  }

  dispose(): void {
    cancelAnimationFrame(this.asked);
    this.resize.disconnect();
    this.controls.dispose();
    this.line.geometry.dispose();
    this.renderer.dispose();
  }

  private nearest(row: number): number {
    const { rows } = this;
    if (rows.length === 0) return -1;
    const span = rows[rows.length - 1]! - rows[0]!;
    const at = span > 0 ? Math.round(((row - rows[0]!) * (rows.length - 1)) / span) : 0;
    return Math.min(rows.length - 1, Math.max(0, at));
  }

  private pick(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    const point = new Vector3();
    let [best, distance] = [-1, reach];
    for (let i = 0; i < this.rows.length; ++i) {
      point.fromArray(this.points, 3 * i).project(this.camera);
      const away = Math.hypot(box.left + ((point.x + 1) / 2) * box.width - event.clientX, box.top + ((1 - point.y) / 2) * box.height - event.clientY);
      if (away < distance) [best, distance] = [i, away];
    }
    if (best >= 0) this.select(this.rows[best]!);
  }

  private measure(): void {
    const [width, height] = [Math.max(1, this.canvas.clientWidth), Math.max(1, this.canvas.clientHeight)];
    this.renderer.setSize(width, height, false);
    [this.camera.left, this.camera.right, this.camera.top, this.camera.bottom] = [-width / 2, width / 2, height / 2, -height / 2];
    this.camera.updateProjectionMatrix();
    this.fit();
  }

  private ask(): void {
    this.asked ||= requestAnimationFrame(() => {
      this.asked = 0;
      // The mark has 5 pixels at any zoom.
      this.mark.scale.setScalar(5 / this.camera.zoom);
      this.renderer.render(this.scene, this.camera);
    });
  }
}
