// SPDX-License-Identifier: Apache-2.0
import { overrideLimits } from "../contract";
import { type Mode, canStart, inhibition } from "../state/model";
import { channel, channelList, channelName, command, machine, stop } from "../state/store";
import { text, type Texts } from "../text/texts";
import { Guard } from "./Guard";
import { onPress } from "./press";

const modes: [Mode, keyof Texts & `mode${string}`][] = [
  ["AUTO", "modeAuto"],
  ["MDI", "modeMdi"],
  ["JOG", "modeJog"],
  ["REF", "modeReference"],
];

interface OverrideProps {
  kind: keyof typeof overrideLimits;
  /** A fraction, as the channel takes it. */
  value: number;
}

function Override({ kind, value }: OverrideProps) {
  const t = text.value;
  const { minimum, maximum } = overrideLimits[kind];
  const title = t[kind];
  const send = (fraction: number) => {
    const limited = Math.min(maximum, Math.max(minimum, fraction));
    void command(t.override(title), "override", { kind, value: limited });
  };
  // An order, not a value: what is shown may be older than the last step.
  const step = (by: number) => void command(t.override(title), "override-step", { kind, step: by });
  const percent = Math.round(value * 100);
  return (
    <div class="override">
      <label for={`override-${kind}`}>{title}</label>
      <button class="step" aria-label={t.overrideDown(title)} onClick={() => step(-0.1)}>
        −
      </button>
      <input
        id={`override-${kind}`}
        type="range"
        min={minimum * 100}
        max={maximum * 100}
        step={5}
        value={percent}
        aria-label={t.override(title)}
        aria-valuetext={`${percent} %`}
        onInput={(event) => send(Number(event.currentTarget.value) / 100)}
      />
      <button class="step" aria-label={t.overrideUp(title)} onClick={() => step(0.1)}>
        +
      </button>
      <button
        class={`digits percent ${percent === 100 ? "" : "changed"}`}
        title={t.overrideBack(title)}
        data-test={`percent-${kind}`}
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
  const t = text.value;
  const inhibited = inhibition(machine.value, one, "start", t.inhibitedByPlc);
  return (
    <section class={`controls ${channelList.value.length > 1 ? "several" : ""}`} aria-label={t.operation}>
      <Guard needs="operator">
        <div class="modes segments" role="group" aria-label={t.mode}>
          {modes.map(([mode, title]) => (
            <button
              key={mode}
              aria-pressed={one.mode === mode}
              data-test={`mode-${mode}`}
              onClick={() => void command(t.mode, "mode", { mode })}
            >
              {t[title] as string}
            </button>
          ))}
        </div>
      </Guard>
      <div class="keys">
        <Guard needs="operator">
          <button
            class="start"
            data-test="cycle-start"
            title={inhibited || "Ctrl+Enter"}
            aria-disabled={!canStart(machine.value, one)}
            onClick={() => void command(t.cycleStart, "cycle-start", {})}
          >
            {t.cycleStart}
          </button>
        </Guard>
        {inhibited && <p class="dim" role="status" data-test="start-inhibited">{inhibited}</p>}
        {channelList.value.length > 1 && (
          <button
            class="hold"
            data-test="hold-channel"
            {...onPress(() => void stop(t.feedHold, `/api/channels/${one.channel}/feed-hold`))}
          >
            {t.holdChannel(channelName(one))}
          </button>
        )}
        <Guard needs="operator">
          <button data-test="reset" onClick={() => void command(t.reset, "reset", {})}>{t.reset}</button>
          <button
            class="toggle"
            aria-pressed={one.single_block}
            onClick={() => void command(t.singleBlock, "single-block", { on: !one.single_block })}
          >
            {t.singleBlock}
          </button>
          <button
            class="toggle"
            aria-pressed={one.optional_stop}
            onClick={() => void command(t.optionalStop, "optional-stop", { on: !one.optional_stop })}
          >
            {t.optionalStop}
          </button>
        </Guard>
      </div>
      <Guard needs="operator">
        <div class="overrides">
          <Override kind="feed" value={one.feed_override} />
          <Override kind="rapid" value={one.rapid_override} />
          <Override kind="spindle" value={one.spindle_override} />
        </div>
      </Guard>
    </section>
  );
}
