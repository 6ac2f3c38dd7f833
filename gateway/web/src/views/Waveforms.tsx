// SPDX-License-Identifier: Apache-2.0
// Signals over time, one lane each, with two cursors. The same component draws a spectrum.
import { useEffect, useRef } from "preact/hooks";
import { shortNumber } from "../format";
import { colour, shownTheme } from "../state/preferences";

export interface Lane {
  name: string;
  unit: string;
  x: Float64Array;
  y: Float64Array;
}

export interface Mark {
  at: number;
  name: string;
}

const names = ["accent", "good", "warn", "axis-x", "curve-5", "curve-6", "curve-7", "curve-8", "curve-9"];
export const laneColour = (index: number) => colour(names[index % names.length]!);
const left = 8, labels = 18, bottom = 20;

function draw(canvas: HTMLCanvasElement, lanes: readonly Lane[], from: number, to: number, marks: readonly Mark[], unit: string): void {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  if (!context) return;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.font = "11px sans-serif";
  const span = Math.max(1e-12, to - from);
  const across = (x: number) => left + ((x - from) / span) * (width - 2 * left);
  const lane = (height - bottom) / Math.max(1, lanes.length);
  lanes.forEach(({ name, unit: of, x, y }, index) => {
    const top = index * lane;
    let [low, high] = [Infinity, -Infinity];
    for (const value of y) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    const range = Math.max(high - low, 1e-9);
    const up = (value: number) => top + labels + (1 - (value - low) / range) * Math.max(4, lane - labels - 6);
    context.strokeStyle = colour("grid");
    context.strokeRect(left, top + 0.5, width - 2 * left, lane - 1);
    context.strokeStyle = context.fillStyle = laneColour(index);
    context.lineWidth = 1.2;
    context.beginPath();
    let joined = false;
    for (let i = 0; i < x.length; ++i) {
      if (Number.isNaN(y[i]!)) joined = false;
      else {
        if (joined) context.lineTo(across(x[i]!), up(y[i]!));
        else context.moveTo(across(x[i]!), up(y[i]!));
        joined = true;
      }
    }
    context.stroke();
    context.fillText(`${name}  ${shortNumber(low)} \u2026 ${shortNumber(high)} ${of}`, left + 6, top + 13);
  });
  context.fillStyle = colour("dim");
  for (let i = 0; i <= 4; ++i) {
    const text = `${shortNumber(from + (i / 4) * span)} ${unit}`;
    context.textAlign = i === 0 ? "left" : i === 4 ? "right" : "center";
    context.fillText(text, left + (i / 4) * (width - 2 * left), height - 5);
  }
  context.textAlign = "left";
  for (const mark of marks) {
    if (mark.at < from || mark.at > to) continue;
    context.strokeStyle = context.fillStyle = colour("text");
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(across(mark.at), 0);
    context.lineTo(across(mark.at), height - bottom);
    context.stroke();
    context.fillText(mark.name, Math.min(across(mark.at) + 3, width - 14), height - bottom - 4);
  }
}

interface Props {
  label: string;
  test: string;
  lanes: readonly Lane[];
  from: number;
  to: number;
  marks: readonly Mark[];
  /** Of the horizontal axis. */
  unit: string;
  /** A place was touched; `second` with Shift. */
  place?: (at: number, second: boolean) => void;
  /** A key or the wheel: by how many rows the cursor moves, or by which factor the range changes about a place. */
  step?: (rows: number, second: boolean) => void;
  zoom?: (factor: number, about: number) => void;
}

export function Waveforms({ label, test, lanes, from, to, marks, unit, place, step, zoom }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const theme = shownTheme.value;
  useEffect(() => {
    const paint = () => canvas.current && draw(canvas.current, lanes, from, to, marks, unit);
    paint();
    const resize = new ResizeObserver(paint);
    resize.observe(canvas.current!);
    return () => resize.disconnect();
  }, [lanes, from, to, marks, unit, theme]);
  const at = (event: MouseEvent) => {
    const box = canvas.current!.getBoundingClientRect();
    return Math.min(to, Math.max(from, from + ((event.clientX - box.left - left) / (box.width - 2 * left)) * (to - from)));
  };
  const keys: Record<string, number> = { ArrowLeft: -1, ArrowRight: 1, PageUp: -100, PageDown: 100 };
  return (
    <canvas
      ref={canvas}
      class="waveforms"
      role="img"
      tabIndex={0}
      aria-label={label}
      data-test={test}
      data-lanes={lanes.length}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        place?.(at(event), event.shiftKey);
      }}
      onPointerMove={(event) => event.buttons === 1 && place?.(at(event), event.shiftKey)}
      onWheel={(event) => {
        if (!zoom) return;
        event.preventDefault();
        zoom(event.deltaY < 0 ? 0.7 : 1 / 0.7, at(event));
      }}
      onKeyDown={(event) => {
        const rows = keys[event.key];
        if (rows !== undefined) step?.(rows, event.shiftKey);
        else if (event.key === "+" || event.key === "-") zoom?.(event.key === "+" ? 0.7 : 1 / 0.7, marks[0]?.at ?? (from + to) / 2);
        else return;
        event.preventDefault();
      }}
    />
  );
}
