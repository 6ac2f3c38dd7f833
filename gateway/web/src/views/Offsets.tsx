// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { type Answer, get, put, type Tool, type WorkOffset } from "../api";
import { millimetres } from "../format";
import { channel, machine, tell } from "../state/store";
import { text } from "../text/texts";

const letters = "XYZABCUVW";

/** Every digit that is stored: what is shown is rounded, what is edited is not. */
const exactly = (value: number) => String(value);

/**
 * A number that is sent when it is entered, and comes back to what is stored when it is refused. While it is being
 * edited nothing else changes it, and nothing is sent when it is left as it was.
 */
function Cell({ value, label, store }: { value: number; label: string; store: (value: number) => Promise<Answer> }) {
  const draft = useSignal<string | null>(null);
  const commit = async () => {
    const typed = draft.value;
    if (typed === null || typed === exactly(value)) {
      draft.value = null;
      return;
    }
    const entered = Number(typed.replace(",", ".").replace("\u2212", "-"));
    if (typed.trim() === "" || !Number.isFinite(entered)) tell(`${label}: ${text.peek().notANumber}`, true);
    else if (entered !== value) {
      const answer = await store(entered);
      if (!answer.ok) tell(`${label}: ${answer.reason}`, true);
    }
    draft.value = null;
  };
  return (
    <input
      class="cell digits"
      aria-label={label}
      value={draft.value ?? millimetres(value)}
      inputMode="decimal"
      onFocus={(event) => {
        const input = event.currentTarget;
        input.value = exactly(value);
        input.select();  // at once: what is typed from here on must not be selected again
        draft.value = input.value;
      }}
      onInput={(event) => {
        draft.value = event.currentTarget.value;
      }}
      onKeyDown={(event) => {
        if (event.key === "Enter") event.currentTarget.blur();
        if (event.key === "Escape") {
          event.stopPropagation();
          draft.value = null;
          event.currentTarget.blur();
        }
      }}
      onBlur={() => void commit()}
    />
  );
}

function WorkOffsets() {
  const table = useSignal<{ revision: number; offsets: WorkOffset[] }>({ revision: 0, offsets: [] });
  const revision = machine.value.revisions.work_offsets;
  useEffect(() => {
    void get<{ revision: number; offsets: WorkOffset[] }>("/api/work-offsets").then((answer) => {
      if (answer.body?.offsets) table.value = answer.body;
    });
  }, [revision]);
  const one = channel.value;
  if (!one) return null;
  const columns = [...letters].map((letter, index) => ({ letter, index })).filter(({ letter }) => one.letters.includes(letter));
  const rows = [0, 1, 2, 3, 4, 5].map(
    (index) =>
      table.value.offsets.find((offset) => offset.channel === one.channel && offset.index === index) ?? {
        channel: one.channel,
        index,
        values: [...letters].map(() => 0),
      },
  );
  const store = (row: WorkOffset, column: number, value: number) => {
    const values = [...letters].map((_, index) => (index === column ? value : (row.values[index] ?? 0)));
    return put("/api/work-offsets", { channel: row.channel, index: row.index, values, revision: table.value.revision });
  };
  return (
    <section class="list" aria-label={text.value.workOffsets}>
      <div class="title">
        <h2>{text.value.workOffsets}</h2>
        <span class="dim">{text.value.workOffsetsAbout}</span>
      </div>
      <div class="scroll">
        <table>
          <thead>
            <tr><td /> {columns.map(({ letter }) => <th class="right" key={letter}>{letter}</th>)}</tr>
          </thead>
          <tbody>
            {rows.map((row) => (
              <tr key={row.index} aria-selected={row.index === one.work_offset}>
                <td><b>G{54 + row.index}</b></td>
                {columns.map(({ letter, index }) => (
                  <td key={letter} class="right">
                    <Cell
                      value={row.values[index] ?? 0}
                      label={`G${54 + row.index} ${letter}`}
                      store={(value) => store(row, index, value)}
                    />
                  </td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function Tools() {
  const tools = useSignal<Tool[]>([]);
  const revision = machine.value.revisions.tools;
  useEffect(() => {
    void get<{ tools: Tool[] }>("/api/tools").then((answer) => {
      if (answer.body?.tools) tools.value = answer.body.tools;
    });
  }, [revision]);
  const t = text.value;
  return (
    <section class="list" aria-label={t.tools}>
      <div class="title">
        <h2>{t.tools}</h2>
        <span class="dim">mm</span>
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.tools}>
        <table>
          <thead>
            <tr>
              <th>T</th><th>{t.name}</th><th class="right">{t.length}</th><th class="right">{t.wear}</th>
              <th class="right">{t.radius}</th><th class="right">{t.wear}</th>
            </tr>
          </thead>
          <tbody>
            {tools.value.map((tool) => (
              <tr key={tool.number} aria-selected={tool.number === channel.value?.tool}>
                <td class="digits"><b>{tool.number}</b></td>
                <td>{tool.name}</td>
                {[tool.length, tool.length_wear, tool.radius, tool.radius_wear].map((value, index) => (
                  <td class="right digits" key={index}>{millimetres(value)}</td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
        {tools.value.length === 0 && <p class="dim">{t.noTools}</p>}
      </div>
    </section>
  );
}

export function Offsets() {
  return (
    <main class="offsets">
      <WorkOffsets />
      <Tools />
    </main>
  );
}
