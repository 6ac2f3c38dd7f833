// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { type Answer, get, put, type Tool, type WorkOffset } from "../api";
import { millimetres } from "../format";
import { channel, machine, tell } from "../state/store";

const letters = "XYZABCUVW";

/** A number that is sent when it is entered, and comes back to what is stored when it is refused. */
function Cell({ value, label, store }: { value: number; label: string; store: (value: number) => Promise<Answer> }) {
  const commit = async (input: HTMLInputElement) => {
    const entered = Number(input.value.replace(",", ".").replace("\u2212", "-"));
    if (input.value.trim() === "" || !Number.isFinite(entered)) tell(`${label}: this is not a number`, true);
    else if (entered !== value) {
      const answer = await store(entered);
      if (answer.ok) return;
      tell(`${label}: ${answer.reason}`, true);
    }
    input.value = millimetres(value);
  };
  return (
    <input
      class="cell digits"
      aria-label={label}
      value={millimetres(value)}
      inputMode="decimal"
      onFocus={(event) => event.currentTarget.select()}
      onKeyDown={(event) => event.key === "Enter" && event.currentTarget.blur()}
      onBlur={(event) => void commit(event.currentTarget)}
    />
  );
}

function WorkOffsets() {
  const offsets = useSignal<WorkOffset[]>([]);
  const revision = machine.value.revisions.work_offsets;
  useEffect(() => {
    void get<{ offsets: WorkOffset[] }>("/api/work-offsets").then((answer) => {
      if (answer.body?.offsets) offsets.value = answer.body.offsets;
    });
  }, [revision]);
  const one = channel.value;
  if (!one) return null;
  const columns = [...letters].map((letter, index) => ({ letter, index })).filter(({ letter }) => one.letters.includes(letter));
  const rows = [0, 1, 2, 3, 4, 5].map(
    (index) =>
      offsets.value.find((offset) => offset.channel === one.channel && offset.index === index) ?? {
        channel: one.channel,
        index,
        values: [...letters].map(() => 0),
      },
  );
  const store = (row: WorkOffset, column: number, value: number) => {
    const values = [...letters].map((_, index) => (index === column ? value : (row.values[index] ?? 0)));
    return put("/api/work-offsets", { channel: row.channel, index: row.index, values });
  };
  return (
    <section class="list" aria-label="work offsets">
      <div class="title">
        <h2>Work offsets</h2>
        <span class="dim">machine coordinates of the workpiece zero, mm and °</span>
      </div>
      <div class="scroll">
        <table>
          <thead>
            <tr><th /> {columns.map(({ letter }) => <th class="right" key={letter}>{letter}</th>)}</tr>
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
  return (
    <section class="list" aria-label="tools">
      <div class="title">
        <h2>Tools</h2>
        <span class="dim">mm</span>
      </div>
      <div class="scroll">
        <table>
          <thead>
            <tr>
              <th>T</th><th>Name</th><th class="right">Length</th><th class="right">Wear</th>
              <th class="right">Radius</th><th class="right">Wear</th>
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
        {tools.value.length === 0 && <p class="dim">No tools.</p>}
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
