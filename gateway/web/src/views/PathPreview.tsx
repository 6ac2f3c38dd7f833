// SPDX-License-Identifier: Apache-2.0
// The path of a checked program beside its text: rapids thin, the line of the cursor marked.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { ProgramPath } from "../contract";
import { colour, shownTheme } from "../state/preferences";
import { fit, type Point2, project, type Rotation, type View } from "../state/projection";
import { text } from "../text/texts";

const views: View[] = ["XY", "XZ", "YZ", "3D"];
const chosen = signal<View>("3D");
const rotation = signal<Rotation>({ turn: 30, tilt: 28 });

function draw(canvas: HTMLCanvasElement, path: ProgramPath | null, line: number): void {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  if (!context || !path) return;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const points = path.x.map((x, i): Point2 => project(chosen.value, rotation.value, x, path.y[i]!, path.z[i]!));
  const { scale, offsetX, offsetY } = fit(points, width, height, 24);
  const stroke = (wanted: (i: number) => boolean, paint: string, thickness: number, dash: number[]) => {
    context.strokeStyle = paint;
    context.lineWidth = thickness;
    context.setLineDash(dash);
    context.beginPath();
    for (let i = 1; i < points.length; ++i) {
      if (!wanted(i)) continue;
      const [from, to] = [points[i - 1]!, points[i]!];
      context.moveTo(offsetX + from[0] * scale, offsetY - from[1] * scale);
      context.lineTo(offsetX + to[0] * scale, offsetY - to[1] * scale);
    }
    context.stroke();
  };
  stroke((i) => path.rapid[i] === true, colour("dim"), 0.7, [4, 4]);
  stroke((i) => path.rapid[i] === false, colour("accent"), 1.2, []);
  stroke((i) => path.line[i] === line, colour("warn"), 3.5, []);
}

/** Degrees of a press of an arrow key. */
const step = 10;
const turns: Record<string, Partial<Rotation>> = { ArrowLeft: { turn: -step }, ArrowRight: { turn: step }, ArrowUp: { tilt: step }, ArrowDown: { tilt: -step } };

function turnBy(turn: number, tilt: number): void {
  const now = rotation.peek();
  rotation.value = { turn: now.turn + turn, tilt: Math.min(90, Math.max(-90, now.tilt + tilt)) };
}

/** `line` is the one of the cursor, from 1. */
export function PathPreview({ path, line }: { path: ProgramPath | null; line: number }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const paint = () => canvas.current && draw(canvas.current, path, line);
    const stops = [chosen.subscribe(paint), rotation.subscribe(paint), shownTheme.subscribe(paint)];
    const resize = new ResizeObserver(paint);
    resize.observe(canvas.current!);
    return () => {
      for (const stop of stops) stop();
      resize.disconnect();
    };
  }, [path, line]);
  const t = text.value;
  const marked = path ? path.line.filter((one) => one === line).length : 0;
  return (
    <div class="tool-path">
      <canvas
        ref={canvas}
        role="img"
        tabIndex={0}
        aria-label={t.pathPreview}
        data-test="path-preview"
        data-points={path?.x.length ?? 0}
        data-marked={marked}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={(event) => {
          if (event.buttons === 1 && chosen.value === "3D") turnBy(event.movementX / 2, event.movementY / 2);
        }}
        onKeyDown={(event) => {
          const by = turns[event.key];
          if (!by) return;
          event.preventDefault();
          turnBy(by.turn ?? 0, by.tilt ?? 0);
        }}
      />
      {path && !path.whole && <p class="dim">{t.pathCut(path.x.length)}</p>}
      <div class="path-keys segments" role="group" aria-label={t.sceneViews}>
        {views.map((name) => (
          <button key={name} aria-pressed={chosen.value === name} onClick={() => (chosen.value = name)}>{name}</button>
        ))}
      </div>
    </div>
  );
}
