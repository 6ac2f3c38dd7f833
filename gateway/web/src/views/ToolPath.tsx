// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { fit, gridStep, type Point2, project, type Rotation, type View } from "../state/projection";
import { colour, shownTheme } from "../state/preferences";
import { channelNumber, history, machine } from "../state/store";
import { text } from "../text/texts";

const views: View[] = ["XY", "XZ", "YZ", "3D"];
/** The newest points are drawn; the 3D view shows all of them. */
const mostPoints = 20_000;
const chosen = signal<View>("3D");
const rotation = signal<Rotation>({ turn: 30, tilt: 28 });

function draw(canvas: HTMLCanvasElement, number: number): void {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  if (!context) return;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  const path = history(number).path;
  const points: Point2[] = [];
  for (let row = Math.max(0, path.length - mostPoints); row < path.length; ++row)
    points.push(project(chosen.value, rotation.value, path.at(row, 0), path.at(row, 1), path.at(row, 2)));
  const { scale, offsetX, offsetY } = fit(points, width, height, 26);
  const at = ([right, up]: Point2): Point2 => [offsetX + right * scale, offsetY - up * scale];

  context.lineWidth = 1;
  context.font = "11px sans-serif";
  const step = gridStep(scale, 60);
  if (chosen.value !== "3D") {
    context.strokeStyle = colour("grid");
    context.beginPath();
    for (let x = Math.ceil(-offsetX / scale / step) * step; offsetX + x * scale < width; x += step) {
      context.moveTo(offsetX + x * scale, 0);
      context.lineTo(offsetX + x * scale, height);
    }
    for (let y = Math.ceil((offsetY - height) / scale / step) * step; offsetY - y * scale > 0; y += step) {
      context.moveTo(0, offsetY - y * scale);
      context.lineTo(width, offsetY - y * scale);
    }
    context.stroke();
  }
  // The directions of the axes, at a fixed place, so that a turned view can be read.
  const colours = [colour("axis-x"), colour("axis-y"), colour("axis-z")];
  const origin: Point2 = [34, height - 34];
  ["X", "Y", "Z"].forEach((letter, index) => {
    const unit = [0, 0, 0];
    unit[index] = 1;
    const [right, up] = project(chosen.value, rotation.value, unit[0]!, unit[1]!, unit[2]!);
    if (Math.hypot(right, up) < 0.05) return;
    context.strokeStyle = context.fillStyle = colours[index]!;
    context.beginPath();
    context.moveTo(origin[0], origin[1]);
    context.lineTo(origin[0] + right * 20, origin[1] - up * 20);
    context.stroke();
    context.fillText(letter, origin[0] + right * 27 - 3, origin[1] - up * 27 + 4);
  });
  context.fillStyle = colour("dim");
  context.fillText(`${step >= 1 ? step : step.toPrecision(1)} mm`, width - 62, height - 12);
  context.strokeStyle = colour("dim");
  context.strokeRect(width - 20 - step * scale, height - 8, step * scale, 0);

  context.strokeStyle = colour("accent");
  context.lineWidth = 1.3;
  context.lineJoin = "round";
  context.beginPath();
  points.forEach((point, index) => (index ? context.lineTo(...at(point)) : context.moveTo(...at(point))));
  context.stroke();
  const tip = points[points.length - 1];
  if (tip) {
    const [x, y] = at(tip);
    context.fillStyle = colour("warn");
    context.beginPath();
    context.arc(x, y, 4, 0, 2 * Math.PI);
    context.fill();
  }
}

export function ToolPath() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const number = channelNumber.value;
  useEffect(() => {
    if (number === null) return;
    let asked = 0;
    let drawn = "";
    const paint = () => {
      asked = 0;
      const element = canvas.current;
      if (!element) return;
      const { turn, tilt } = rotation.value;
      const key = [history(number).path.pushed, chosen.value, shownTheme.value, turn, tilt, element.clientWidth, element.clientHeight].join();
      if (key === drawn) return;
      drawn = key;
      draw(element, number);
    };
    const ask = () => (asked ||= requestAnimationFrame(paint));
    const stops = [machine.subscribe(ask), chosen.subscribe(ask), shownTheme.subscribe(ask), rotation.subscribe(ask)];
    return () => {
      for (const stop of stops) stop();
      cancelAnimationFrame(asked);
    };
  }, [number]);
  return (
    <div class="tool-path">
      <canvas
        ref={canvas}
        role="img"
        aria-label={text.value.toolPathAbout}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={(event) => {
          if (event.buttons !== 1 || chosen.value !== "3D") return;
          const { turn, tilt } = rotation.value;
          rotation.value = {
            turn: turn + event.movementX * 0.5,
            tilt: Math.min(90, Math.max(-90, tilt + event.movementY * 0.5)),
          };
        }}
      />
      <div class="path-keys segments" role="group" aria-label={text.value.sceneViews}>
        {views.map((name) => (
          <button key={name} aria-pressed={chosen.value === name} onClick={() => (chosen.value = name)}>
            {name}
          </button>
        ))}
        <button onClick={() => number !== null && history(number).clear()}>{text.value.clear}</button>
      </div>
    </div>
  );
}
