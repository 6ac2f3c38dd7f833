// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { follow, type ProgramText } from "../program/lines";
import { text as texts } from "../text/texts";

const lineHeight = 21;

/**
 * Shows a window of the program and scrolls by lines itself: a browser's own scroll area cannot be as high as a
 * million lines. It follows the executed line until the operator scrolls, and again when that line changes 3 s later.
 */
export function ProgramView({ text, line, failing }: { text: ProgramText; line: number; failing: number }) {
  const first = useSignal(1);
  const visible = useSignal(20);
  const place = useRef<HTMLDivElement>(null);
  const scrolledAt = useRef(-Infinity);
  useLayoutEffect(() => {
    const element = place.current!;
    const measure = () => (visible.value = Math.max(3, Math.floor(element.clientHeight / lineHeight)));
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    measure();
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    if (performance.now() - scrolledAt.current < 3000) return;
    first.value = follow(first.peek(), visible.peek(), failing || line, text.count);
  }, [line, failing, text, visible.value]);

  const last = Math.max(1, text.count - visible.value + 1);
  const scrollTo = (wanted: number) => {
    scrolledAt.current = performance.now();
    first.value = Math.min(last, Math.max(1, Math.round(wanted)));
  };
  const steps: Record<string, number> = {
    ArrowUp: -1,
    ArrowDown: 1,
    PageUp: -visible.value + 1,
    PageDown: visible.value - 1,
    Home: -Infinity,
    End: Infinity,
  };
  const shown = Array.from({ length: Math.min(visible.value, text.count) }, (_, row) => first.value + row);
  const thumb = Math.max(0.04, Math.min(1, visible.value / Math.max(1, text.count)));
  const part = last > 1 ? (first.value - 1) / (last - 1) : 0;
  const dragTo = (event: PointerEvent, bar: HTMLElement) => {
    const box = bar.getBoundingClientRect();
    scrollTo(1 + ((event.clientY - box.top) / box.height) * (last - 1));
  };
  return (
    <div
      class="code"
      ref={place}
      tabIndex={0}
      role="region"
      aria-label={texts.value.programText}
      onWheel={(event) => scrollTo(first.value + Math.sign(event.deltaY) * Math.max(1, Math.abs(event.deltaY) / 40))}
      onKeyDown={(event) => {
        const step = steps[event.key];
        if (step === undefined) return;
        event.preventDefault();
        scrollTo(first.value + step);
      }}
    >
      <div class="lines">
        {shown.map((number) => (
          <div
            class={`line ${number === line ? "current" : ""} ${number === failing ? "failing" : ""}`}
            data-test={number === failing ? "failing-line" : undefined}
            key={number}
          >
            <span class="number digits">{number}</span>
            <span class="text" data-test={number === line ? "current-line" : undefined} title={text.line(number)}>
              {text.line(number)}
            </span>
          </div>
        ))}
      </div>
      {last > 1 && (
        <div
          class="bar"
          onPointerDown={(event) => {
            event.currentTarget.setPointerCapture(event.pointerId);
            dragTo(event, event.currentTarget);
          }}
          onPointerMove={(event) => event.buttons === 1 && dragTo(event, event.currentTarget)}
        >
          <i style={{ height: `${thumb * 100}%`, top: `${part * (1 - thumb) * 100}%` }} />
        </div>
      )}
    </div>
  );
}
