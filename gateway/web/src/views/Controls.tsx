// SPDX-License-Identifier: Apache-2.0
import { type Mode, canStart } from "../state/model";
import { channel, command, machine, stop } from "../state/store";
import { onPress } from "./press";

const modes: [Mode, string][] = [
  ["AUTO", "Auto"],
  ["MDI", "MDI"],
  ["JOG", "Jog"],
  ["REF", "Reference"],
];

interface OverrideProps {
  kind: "feed" | "rapid" | "spindle";
  title: string;
  /** Fractions, as the channel takes them. */
  minimum: number;
  maximum: number;
  value: number;
}

function Override({ kind, title, minimum, maximum, value }: OverrideProps) {
  const send = (fraction: number) => {
    const limited = Math.min(maximum, Math.max(minimum, fraction));
    void command(`${title} override`, "override", { kind, value: limited });
  };
  // An order, not a value: what is shown may be older than the last step.
  const step = (by: number) => void command(`${title} override`, "override-step", { kind, step: by });
  const percent = Math.round(value * 100);
  return (
    <div class="override">
      <label for={`override-${kind}`}>{title}</label>
      <button class="step" aria-label={`${title} override down`} onClick={() => step(-0.1)}>
        −
      </button>
      <input
        id={`override-${kind}`}
        type="range"
        min={minimum * 100}
        max={maximum * 100}
        step={5}
        value={percent}
        onInput={(event) => send(Number(event.currentTarget.value) / 100)}
      />
      <button class="step" aria-label={`${title} override up`} onClick={() => step(0.1)}>
        +
      </button>
      <button
        class={`digits percent ${percent === 100 ? "" : "changed"}`}
        title="back to 100 %"
        onClick={() => send(1)}
      >
        {percent} %
      </button>
    </div>
  );
}

export function Controls() {
  const one = channel.value;
  if (!one) return null;
  return (
    <section class="controls" aria-label="operation">
      <div class="modes segments" role="group" aria-label="mode">
        {modes.map(([mode, title]) => (
          <button
            key={mode}
            aria-pressed={one.mode === mode}
            data-test={`mode-${mode}`}
            onClick={() => void command("Mode", "mode", { mode })}
          >
            {title}
          </button>
        ))}
      </div>
      <div class="keys">
        <button
          class="start"
          data-test="cycle-start"
          title="Ctrl+Enter"
          aria-disabled={!canStart(machine.value, one)}
          onClick={() => void command("Cycle start", "cycle-start", {})}
        >
          Cycle start
        </button>
        <button class="hold" data-test="feed-hold" title="Esc" {...onPress(() => void stop("Feed hold", `/api/channels/${one.channel}/feed-hold`))}>
          Feed hold
        </button>
        <button data-test="reset" onClick={() => void command("Reset", "reset", {})}>Reset</button>
        <button
          class="toggle"
          aria-pressed={one.single_block}
          onClick={() => void command("Single block", "single-block", { on: !one.single_block })}
        >
          Single block
        </button>
        <button
          class="toggle"
          aria-pressed={one.optional_stop}
          onClick={() => void command("Optional stop", "optional-stop", { on: !one.optional_stop })}
        >
          Optional stop
        </button>
      </div>
      <div class="overrides">
        <Override kind="feed" title="Feed" minimum={0} maximum={1.5} value={one.feed_override} />
        <Override kind="rapid" title="Rapid" minimum={0} maximum={1} value={one.rapid_override} />
        <Override kind="spindle" title="Spindle" minimum={0.5} maximum={1.5} value={one.spindle_override} />
      </div>
    </section>
  );
}
