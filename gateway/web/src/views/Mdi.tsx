// SPDX-License-Identifier: Apache-2.0
import { effect, signal } from "@preact/signals";
import { post } from "../api";
import { refusal } from "../format";
import { errorsOf, historyOf, maximumLineLength, MdiRun, mdiLines, remembered } from "../state/mdi";
import { keep, kept } from "../state/preferences";
import { channel, channels, command, machine, tell } from "../state/store";
import { text } from "../text/texts";

const entered = signal("");
const history = signal<string[]>(historyOf(kept("mdi")));
/** The channel and the rest of the lines that are being executed. */
const running = signal<{ channel: number; run: MdiRun } | null>(null);

/** Why the rest was not executed, or nothing when the last line was executed. */
function end(reason: string): void {
  const was = running.peek();
  running.value = null;
  if (!was || !reason) return;
  const { accepted, lines } = was.run;
  const rest = lines.length > 1 ? ` ${text.peek().mdiEnded(Math.min(accepted + 1, lines.length), lines.length)}` : "";
  tell(`${refusal(text.peek().mdi, reason)}${rest}`, true);
}

let asking = false;

/** Sends the next line as soon as the channel is ready for it. */
async function advance(): Promise<void> {
  const now = running.peek();
  const one = now && channels.peek()[String(now.channel)];
  if (!now || !one || asking) return;
  const { run } = now;
  const step = run.next(one, errorsOf(machine.peek().alarms));
  if (step === "done") return end("");
  if (step === "ended") {
    running.value = null;
    const last = run.accepted;
    if (last < run.lines.length) tell(text.peek().mdiEnded(last, run.lines.length), true);
    return;
  }
  if (step === "wait") return;
  asking = true;
  const answer = await post(`/api/channels/${now.channel}/mdi`, { line: run.lines[run.accepted]! });
  asking = false;
  if (answer.ok) run.accepted += 1;
  if (running.peek() !== now) return;
  if (!answer.ok) return end(answer.reason);
  running.value = { ...now };
  if (entered.peek().trim() === run.lines.join("\n") && run.accepted === run.lines.length) entered.value = "";
}

effect(() => {
  // The stream comes at least twice a second, so a line that needs no motion is followed by the next one.
  void machine.value;
  void running.value;
  void advance();
});

async function execute(): Promise<void> {
  const lines = mdiLines(entered.peek());
  const one = channel.peek();
  if (lines.length === 0 || !one || running.peek()) return;
  history.value = remembered(history.peek(), lines.join("\n"));
  keep("mdi", JSON.stringify(history.peek()));
  entered.value = lines.join("\n");
  if (one.mode !== "MDI" && !(await command(text.peek().mode, "mode", { mode: "MDI" }))) return;
  const now = channels.peek()[String(one.channel)] ?? one;
  running.value = { channel: one.channel, run: new MdiRun(lines, now.reset_count, errorsOf(machine.peek().alarms)) };
}

export function Mdi() {
  const t = text.value;
  const now = running.value;
  return (
    <form
      class="mdi"
      aria-label={t.mdi}
      onSubmit={(event) => {
        event.preventDefault();
        void execute();
      }}
    >
      <textarea
        id="mdi"
        data-test="mdi"
        aria-label={t.mdiLines}
        rows={3}
        value={entered.value}
        spellcheck={false}
        autocomplete="off"
        placeholder={t.mdiPlaceholder}
        aria-invalid={mdiLines(entered.value).some((line) => line.length > maximumLineLength)}
        onInput={(event) => (entered.value = event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key !== "Enter" || !event.ctrlKey) return;
          event.preventDefault();
          void execute();
        }}
      />
      <div class="mdi-keys">
        <select
          aria-label={t.mdiHistory}
          data-test="mdi-history"
          value=""
          disabled={history.value.length === 0}
          onChange={(event) => {
            entered.value = history.peek()[Number(event.currentTarget.value)] ?? entered.peek();
            event.currentTarget.value = "";
          }}
        >
          <option value="">{t.mdiHistory}</option>
          {history.value.map((lines, index) => (
            <option key={lines} value={String(index)}>{lines.replace(/\n/g, " / ")}</option>
          ))}
        </select>
        {now ? (
          <button type="button" data-test="mdi-cancel" onClick={() => (running.value = null)}>{t.stopMdi}</button>
        ) : (
          <button type="submit" class="primary" data-test="mdi-send">{t.execute}</button>
        )}
      </div>
      {now && <p class="dim digits" data-test="mdi-line">{t.mdiRunning(now.run.accepted, now.run.lines.length)}</p>}
    </form>
  );
}
