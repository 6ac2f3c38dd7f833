// SPDX-License-Identifier: Apache-2.0
// The path of a recording in 3D, coloured by what the operator chooses.
import { useSignal } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import type { Axes } from "../analysis/offered";
import type { Recording } from "../analysis/recording";
import { type Quantity, quantityOf } from "../analysis/signals";
import { tipColumns } from "../analysis/tip";
import { shortNumber, typedNumber } from "../format";
import type { Chain } from "../scene/chain";
import type { RecordedPath } from "../scene/recorded_path";
import { speedColour } from "../scene/path";
import { colour, shownTheme } from "../state/preferences";
import { channel } from "../state/store";
import { text } from "../text/texts";

const colours = Array.from({ length: 9 }, (_, i) => `rgb(${speedColour(i / 8).join()})`).join();
const units: Record<Quantity, string> = { speed: "mm/s", acceleration: "mm/s\u00b2", jerk: "mm/s\u00b3", following: "mm" };

interface Props {
  recording: Recording;
  axes: Axes;
  first: number;
  last: number;
  selected: number;
  select: (row: number) => void;
}

export function RecordedScene({ recording, axes, first, last, selected, select }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const shown = useSignal<RecordedPath | null>(null);
  const failed = useSignal(false);
  const quantity = useSignal<Quantity>("speed");
  const of = useSignal("");
  const frame = useSignal<"machine" | "workpiece">("machine");
  const tool = useSignal(String(channel.peek()?.tool_length || 0));
  const chain = useSignal<Chain | undefined>(undefined);
  const scale = useSignal(0);
  const theme = shownTheme.value;
  const chosen = useRef(select);
  chosen.current = select;
  const t = text.value;

  useEffect(() => {
    let made: RecordedPath | undefined;
    let ended = false;
    void import("../scene/recorded_path").then(({ RecordedPath: Path }) => {
      if (ended || !canvas.current) return;
      try {
        made = new Path(canvas.current, (row) => chosen.current(row));
        shown.value = made;
      } catch {
        failed.value = true;
      }
    });
    return () => {
      ended = true;
      made?.dispose();
      shown.value = null;
    };
  }, []);
  useEffect(() => {
    const one = channel.peek();
    if (frame.value !== "workpiece" || !one) return;
    let ended = false;
    const read = async () => {
      const { readMachine } = await import("../scene/machine_data");
      const machine = await readMachine(one);
      if (!ended) chain.value = machine?.chain;
    };
    void read();
    return () => {
      ended = true;
    };
  }, [frame.value]);
  const length = typedNumber(tool.value) ?? 0;
  const used = frame.value === "workpiece" ? chain.value : undefined;
  const tips = useMemo(() => used && tipColumns(used, axes.positions, length), [used, axes, length]);
  const fitted = useRef<unknown[]>([]);
  useEffect(() => {
    const path = shown.value;
    if (!path || (frame.value === "workpiece" && !tips)) return;
    const [x, y, z] = [..."XYZ"].map((letter) => (tips ?? axes.positions).get(letter));
    const point = (row: number): [number, number, number] => [x?.[row] ?? 0, y?.[row] ?? 0, z?.[row] ?? 0];
    const measure = (letters: string[], positions: Axes["positions"], commanded: Axes["commanded"]) =>
      quantityOf(quantity.value, letters, positions, commanded, recording.cycles, recording.period) ?? new Float64Array(recording.cycles.length);
    const ofTip = () => {
      const commanded = used && quantity.value === "following" ? tipColumns(used, axes.commanded, length) : new Map<string, Float64Array>();
      return measure([..."XYZ"], tips ?? new Map<string, Float64Array>(), commanded);
    };
    const ofAxes = () => measure(of.value === "" ? axes.linear : [of.value], axes.positions, axes.commanded);
    path.set(point, tips && of.value === "" ? ofTip() : ofAxes(), first, last);
    scale.value = path.scale;
    const shape = [recording, frame.value, tool.value];
    if (shape.some((part, i) => part !== fitted.current[i])) path.look("space");
    fitted.current = shape;
    path.showRow(selected, colour("warn"));
  }, [shown.value, recording, axes, first, last, quantity.value, of.value, frame.value, tips]);
  useEffect(() => shown.value?.showRow(selected, colour("warn")), [selected, theme]);

  const quantities: Quantity[] = ["speed", "acceleration", "jerk", ...(axes.commanded.size > 0 ? (["following"] as const) : [])];
  const names: Record<Quantity, string> = { speed: t.pathSpeed, acceleration: t.pathAcceleration, jerk: t.pathJerk, following: t.followingError };
  return (
    <section class="recorded-scene" aria-label={t.recordedPath}>
      <div class="title">
        <select aria-label={t.colourBy} value={quantity.value} onChange={(event) => (quantity.value = event.currentTarget.value as Quantity)}>
          {quantities.map((one) => <option key={one} value={one}>{names[one]}</option>)}
        </select>
        <select aria-label={t.colourOf} value={of.value} onChange={(event) => (of.value = event.currentTarget.value)}>
          <option value="">{frame.value === "workpiece" ? t.colourOfTip : axes.linear.join(" ")}</option>
          {axes.all.map((letter) => <option key={letter} value={letter}>{letter}</option>)}
        </select>
        <select aria-label={t.frame} value={frame.value} onChange={(event) => (frame.value = event.currentTarget.value as "machine" | "workpiece")}>
          <option value="machine">{t.frameMachine}</option>
          <option value="workpiece">{t.frameWorkpiece}</option>
        </select>
        {frame.value === "workpiece" && (
          <input class="short digits" inputMode="decimal" aria-label={t.toolLengthMm} title={t.toolLengthMm} value={tool.value} onChange={(event) => (tool.value = event.currentTarget.value)} />
        )}
        <button onClick={() => shown.value?.look("space")}>{t.sceneFit}</button>
      </div>
      <div class="scene-place">
        <canvas ref={canvas} tabIndex={0} role="img" aria-label={t.recordedPathAbout} data-test="recorded-path" />
      </div>
      {failed.value ? (
        <p role="status">{t.sceneMissing}</p>
      ) : (
        <div class="row digits">
          <span class="scale" style={{ background: `linear-gradient(90deg, ${colours})` }} />
          <span>0 … {shortNumber(scale.value)} {units[quantity.value]}</span>
        </div>
      )}
    </section>
  );
}
