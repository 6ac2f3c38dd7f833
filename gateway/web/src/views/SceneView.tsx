// SPDX-License-Identifier: Apache-2.0
import { signal, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { duration } from "../format";
import { speedColour } from "../scene/path";
import { type Standpoint, standpointOf } from "../scene/standpoint";
import type { FixedView, Layer, Viewer } from "../scene/viewer";
import { colour, keep, kept, shownTheme } from "../state/preferences";
import { plan } from "../state/plan";
import { channel, channelNumber, history, machine } from "../state/store";
import { text, type Texts } from "../text/texts";

const views: [FixedView, keyof Texts & `scene${string}`][] = [
  ["front", "sceneFront"], ["right", "sceneRight"], ["top", "sceneTop"], ["space", "sceneSpace"],
];
const layers: [Layer, keyof Texts & `scene${string}`][] = [
  ["machine", "sceneMachine"], ["travel", "sceneTravel"], ["programmed", "sceneProgrammed"], ["path", "scenePath"],
];
const shown = signal<Record<Layer, boolean>>({ machine: true, travel: true, programmed: true, path: true });
const following = signal(false);
const scaleColours = Array.from({ length: 9 }, (_, i) => `rgb(${speedColour(i / 8).join()})`).join();

/** Of the operator's choice; undefined: machine, workpiece zero and paths fill the picture. */
let standpoint = standpointOf(kept("scene"));

function remember(chosen: Standpoint | undefined): void {
  standpoint = chosen;
  keep("scene", chosen ? JSON.stringify(chosen) : "");
}

type Status = "sceneLoading" | "sceneMissing" | "sceneNoChain" | "";

export function SceneView() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const viewer = useRef<Viewer | undefined>(undefined);
  const status = useSignal<Status>("sceneLoading");
  const facts = useSignal({ segments: 0, scale: 0 });
  const number = channelNumber.value;
  const { parameters, tools, work_offsets } = machine.value.revisions;
  const resets = channel.value?.reset_count;

  useEffect(() => {
    if (number === null) return;
    let ended = false;
    const stops: (() => void)[] = [];
    const open = async () => {
      const now = channel.peek();
      const [{ Viewer }, { readMachine }] = await Promise.all([import("../scene/viewer"), import("../scene/machine_data")]);
      const data = now && (await readMachine(now));
      if (ended || !canvas.current) return;
      if (!data) {
        status.value = "sceneNoChain";
        return;
      }
      let made: Viewer;
      try {
        made = new Viewer(canvas.current, data);
      } catch {
        status.value = "sceneMissing";
        return;
      }
      viewer.current = made;
      status.value = "";
      for (const [layer] of layers) made.show(layer, shown.peek()[layer]);
      made.follow(following.peek());
      made.onMoved = () => remember(made.standpoint);
      let first = true;
      const follow = () => {
        // Nothing is computed or drawn for a tab that is not seen; the history goes on.
        const one = channel.peek();
        if (document.hidden || !one) return;
        made.update(one, history(one.channel));
        if (first && standpoint) made.stand(standpoint);
        else if (first) made.fit(true);
        first = false;
        if (facts.peek().segments !== made.segments || facts.peek().scale !== made.scale)
          facts.value = { segments: made.segments, scale: made.scale };
      };
      const zero = data.offsets.find((offset) => offset.channel === number && offset.index === 0)?.values ?? [];
      const programmed = () => {
        made.program(plan.value?.channel === number ? plan.value.path : undefined, [zero[0] ?? 0, zero[1] ?? 0, zero[2] ?? 0]);
        made.refit();
      };
      stops.push(plan.subscribe(programmed), machine.subscribe(follow), shownTheme.subscribe(() => made.paint(colour)), () => made.dispose());
    };
    void open();
    return () => {
      ended = true;
      for (const stop of stops) stop();
      viewer.current = undefined;
    };
  }, [number, parameters, tools, work_offsets, resets]);

  const seen = (from: (made: Viewer) => void) => {
    if (!viewer.current) return;
    from(viewer.current);
    remember(viewer.current.standpoint);
  };
  const whole = () => {
    viewer.current?.fit(true);
    remember(undefined);
  };
  const t = text.value;
  const planned = plan.value;
  return (
    <main class="scene" aria-label={t.scene}>
      <canvas
        ref={canvas}
        key={[number, parameters, tools, work_offsets, resets].join()}
        tabIndex={0}
        role="img"
        aria-label={t.scenePicture}
        data-test="scene"
        onKeyUp={(event) => {
          if (event.key.startsWith("Arrow")) viewer.current?.moved();
        }}
      />
      <div class="scene-keys">
        <div class="segments" role="group" aria-label={t.sceneViews}>
          {views.map(([name, title]) => (
            <button key={name} data-test={`look-${name}`} onClick={() => seen((made) => made.look(name))}>{t[title] as string}</button>
          ))}
          <button data-test="look-fit" onClick={() => seen((made) => made.fit())}>{t.sceneFit}</button>
          <button data-test="look-whole" onClick={whole}>{t.sceneWhole}</button>
        </div>
        <div class="segments" role="group" aria-label={t.sceneShow}>
          {layers.map(([layer, title]) => (
            <button
              key={layer}
              aria-pressed={shown.value[layer]}
              onClick={() => {
                shown.value = { ...shown.value, [layer]: !shown.value[layer] };
                viewer.current?.show(layer, shown.value[layer]);
              }}
            >
              {t[title] as string}
            </button>
          ))}
        </div>
        <button
          aria-pressed={following.value}
          onClick={() => {
            following.value = !following.value;
            viewer.current?.follow(following.value);
          }}
        >
          {t.sceneFollow}
        </button>
        <button onClick={() => number !== null && history(number).clear()}>{t.clear}</button>
      </div>
      {status.value ? (
        <p class="scene-facts" role="status">{t[status.value] as string}</p>
      ) : (
        <div class="scene-facts digits">
          <span data-test="segments">{t.sceneSegments(facts.value.segments)}</span>
          <span class="scale" style={{ background: `linear-gradient(90deg, ${scaleColours})` }} />
          <span>{t.sceneSpeed(facts.value.scale)}</span>
          {planned && <span>{t.scenePlanned(planned.program, (planned.complete ? "" : "> ") + duration(planned.seconds))}</span>}
          {planned?.alarm !== undefined && <span class="warn" role="status" data-test="plan-alarm">{planned.alarm}</span>}
        </div>
      )}
    </main>
  );
}
