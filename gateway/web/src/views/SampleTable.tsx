// SPDX-License-Identifier: Apache-2.0
// Rows of a recording around the selected one. It scrolls by rows itself: a browser's scroll area is not a million rows high.
import { useSignal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import type { Signal } from "../analysis/offered";
import { type Recording, secondsOf } from "../analysis/recording";
import { fixed } from "../format";
import { text } from "../text/texts";

const rowHeight = 28, head = 30;

interface Props {
  recording: Recording;
  signals: readonly Signal[];
  selected: number;
  select: (row: number) => void;
}

const exactly = (value: number) => (Number.isNaN(value) ? "" : String(Number(value.toPrecision(9))));

export function SampleTable({ recording, signals, selected, select }: Props) {
  const place = useRef<HTMLDivElement>(null);
  const visible = useSignal(6);
  const first = useSignal(0);
  const count = recording.cycles.length;
  useLayoutEffect(() => {
    const measure = () => (visible.value = Math.max(2, Math.floor((place.current!.clientHeight - head) / rowHeight)));
    const observer = new ResizeObserver(measure);
    observer.observe(place.current!);
    measure();
    return () => observer.disconnect();
  }, []);
  const last = Math.max(0, count - visible.value);
  const limited = (row: number) => Math.min(last, Math.max(0, row));
  useEffect(() => {
    if (selected < first.peek() || selected >= first.peek() + visible.peek()) first.value = limited(selected - Math.floor(visible.peek() / 2));
  }, [selected, recording]);
  const keys: Record<string, number> = { ArrowUp: -1, ArrowDown: 1, PageUp: -visible.value, PageDown: visible.value, Home: -count, End: count };
  const t = text.value;
  const start = limited(first.value);
  return (
    <section class="sample-table" aria-label={t.sampleTable}>
      <div
        class="scroll"
        ref={place}
        tabIndex={0}
        role="region"
        aria-label={t.sampleTable}
        onWheel={(event) => {
          event.preventDefault();
          first.value = limited(start + Math.sign(event.deltaY) * 3);
        }}
        onKeyDown={(event) => {
          const by = keys[event.key];
          if (by === undefined) return;
          event.preventDefault();
          select(Math.min(count - 1, Math.max(0, selected + by)));
        }}
      >
        <table class="digits">
          <thead>
            <tr><th>{t.cycle}</th><th class="right">s</th>{signals.map(({ name }) => <th class="right" key={name}>{name}</th>)}</tr>
          </thead>
          <tbody>
            {Array.from({ length: Math.min(visible.value, count) }, (_, i) => start + i).map((row) => (
              <tr key={row} aria-selected={row === selected} data-row={row} onClick={() => select(row)}>
                <td>{recording.cycles[row]}</td>
                <td class="right">{fixed(secondsOf(recording, row), 4)}</td>
                {signals.map((signal) => <td class="right" key={signal.name}>{exactly(signal.values()[row] ?? NaN)}</td>)}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}
