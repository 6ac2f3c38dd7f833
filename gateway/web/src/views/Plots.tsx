// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { tickTexts } from "../format";
import { historySeconds } from "../state/history";
import { colour, shownTheme } from "../state/preferences";
import { channel, channelNumber, history, machine } from "../state/store";
import { text } from "../text/texts";

const names = ["accent", "good", "warn", "axis-x", "curve-5", "curve-6", "curve-7", "curve-8", "curve-9"];
const curveColour = (index: number) => colour(names[index % names.length]!);

function axis(size: number): uPlot.Axis {
  return {
    stroke: colour("dim"),
    font: "11px sans-serif",
    grid: { stroke: colour("grid"), width: 1 },
    ticks: { show: false },
    size,
    gap: 4,
  };
}

function makePlot(place: HTMLElement, title: string, series: uPlot.Series[]): uPlot {
  const options: uPlot.Options = {
    title,
    width: Math.max(100, place.clientWidth),
    height: Math.max(60, place.clientHeight),
    cursor: { show: false },
    legend: { show: false },
    scales: {
      x: { time: false, range: () => [-historySeconds, 0] },
      // A flat line in the middle of an axis of noise says nothing, so the range includes zero.
      y: { range: (_, low, high) => [Math.min(0, low ?? 0), Math.max(high ?? 0, 1e-4) * 1.1] },
    },
    axes: [
      { ...axis(22), values: (_, ticks) => ticks.map((t) => `${t} s`) },
      { ...axis(60), values: (_, ticks, _axis, _space, step) => tickTexts(ticks, step) },
    ],
    series: [{}, ...series],
  };
  return new uPlot(options, [[]], place);
}

export function Plots() {
  const feedPlace = useRef<HTMLDivElement>(null);
  const lagPlace = useRef<HTMLDivElement>(null);
  const number = channelNumber.value;
  const letters = channel.value?.letters ?? "";
  useEffect(() => {
    if (number === null) return;
    const feed = makePlot(feedPlace.current!, text.peek().feedPlot, [{ stroke: curveColour(0), width: 1.5 }]);
    const lag = makePlot(
      lagPlace.current!,
      text.peek().followingErrorPlot,
      [...letters].map((_, index) => ({ stroke: curveColour(index), width: 1.2 })),
    );
    const resize = new ResizeObserver(() => {
      for (const [plot, place] of [[feed, feedPlace.current], [lag, lagPlace.current]] as const)
        if (place) plot.setSize({ width: Math.max(100, place.clientWidth), height: Math.max(60, place.clientHeight - 22) });
    });
    resize.observe(feedPlace.current!);
    let asked = 0;
    let drawnAt = 0;
    const draw = () => {
      asked = 0;
      // Ten pictures a second are as good as twenty to the eye and half the work.
      if (performance.now() - drawnAt < 95) return;
      drawnAt = performance.now();
      const samples = history(number).samples;
      const time = samples.column(0);
      const now = time[time.length - 1] ?? 0;
      const ago = time.map((t) => t - now);
      feed.setData([ago, samples.column(1)]);
      lag.setData([ago, ...[...letters].map((_, index) => samples.column(2 + index))]);
    };
    const stop = machine.subscribe(() => (asked ||= requestAnimationFrame(draw)));
    return () => {
      stop();
      cancelAnimationFrame(asked);
      resize.disconnect();
      feed.destroy();
      lag.destroy();
    };
  }, [number, letters, text.value, shownTheme.value]);
  return (
    <div class="plots">
      <div class="plot" ref={feedPlace} />
      <div class="plot" ref={lagPlace} />
      <div class="legend">
        {[...letters].map((letter, index) => (
          <span key={letter} style={{ color: curveColour(index) }}>
            {letter}
          </span>
        ))}
      </div>
    </div>
  );
}
