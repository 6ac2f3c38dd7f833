// SPDX-License-Identifier: Apache-2.0
// The tool table.
import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { type Answer, get, put, remove } from "../api";
import type { Tool, ToolTable } from "../contract";
import { millimetres, refusal } from "../format";
import { channel, machine, tell } from "../state/store";
import { changedSince, remember } from "../state/undo";
import { text } from "../text/texts";
import { Cell, typedNumber } from "./Cell";
import { Guard, lacking } from "./Guard";
import { ask } from "./Question";

const table = signal<ToolTable>({ set: 0, revision: 0, tools: [] });
const chosen = signal<number | null>(null);

const read = () => get<ToolTable>("/api/tools");

async function refresh(): Promise<void> {
  const answer = await read();
  if (answer.body?.tools) table.value = answer.body;
}

const send = ({ number, ...fields }: Tool, revision: number) => put(`/api/tools/${number}`, { ...fields, revision });
const take = (number: number, revision: number) => remove(`/api/tools/${number}?revision=${revision}`);
const same = (a: Tool | undefined, b: Tool | undefined) => JSON.stringify(a) === JSON.stringify(b);

/** From one row to another; nothing = the tool is not in the table. The change can be taken back. */
async function change(before: Tool | undefined, after: Tool | undefined, what: string): Promise<Answer> {
  const number = (after ?? before)!.number;
  const apply = (row: Tool | undefined, revision: number) => (row ? send(row, revision) : take(number, revision));
  const answer = await apply(after, table.peek().revision);
  if (!answer.ok) return answer;
  remember({
    what,
    undo: async () => {
      const now = await read();
      if (!now.body) return now;
      const row = now.body.tools.find((tool) => tool.number === number);
      return same(row, after) ? apply(before, now.body.revision) : changedSince();
    },
  });
  await refresh();
  return answer;
}

type Field = "length" | "length_wear" | "radius" | "radius_wear";

function NewTool() {
  const number = useSignal("");
  const t = text.value;
  const create = async () => {
    const wanted = typedNumber(number.value);
    if (wanted === undefined || !Number.isInteger(wanted) || wanted < 1) return tell(`${t.toolNumber}: ${t.notANumber}`, true);
    if (table.peek().tools.some((tool) => tool.number === wanted)) return tell(t.toolExists(wanted), true);
    const made = { number: wanted, length: 0, length_wear: 0, radius: 0, radius_wear: 0, name: "" };
    const answer = await change(undefined, made, t.toolCreated(wanted));
    if (!answer.ok) return tell(refusal(`T${wanted}`, answer.reason), true);
    number.value = "";
    chosen.value = wanted;
  };
  return (
    <form
      class="row"
      aria-label={t.newTool}
      onSubmit={(event) => {
        event.preventDefault();
        void create();
      }}
    >
      <input class="short digits" inputMode="numeric" aria-label={t.toolNumber} placeholder="T" value={number.value} onInput={(event) => (number.value = event.currentTarget.value)} />
      <button type="submit">{t.newTool}</button>
    </form>
  );
}

/** The name is stored when it is left; while it is typed nothing else changes it. */
function NameCell({ tool }: { tool: Tool }) {
  const draft = useSignal<string | null>(null);
  const label = text.value.toolName(tool.number);
  const commit = async () => {
    const name = draft.value;
    if (name !== null && name !== tool.name) {
      const answer = await change(tool, { ...tool, name }, `T${tool.number} ${tool.name} → ${name}`);
      if (!answer.ok) tell(refusal(label, answer.reason), true);
    }
    draft.value = null;
  };
  return (
    <input
      class="name-cell"
      aria-label={label}
      disabled={lacking("setter") !== ""}
      value={draft.value ?? tool.name}
      maxLength={64}
      onInput={(event) => (draft.value = event.currentTarget.value)}
      onBlur={() => void commit()}
      onKeyDown={(event) => {
        if (event.key === "Enter") event.currentTarget.blur();
        if (event.key === "Escape") {
          event.stopPropagation();
          draft.value = null;
          event.currentTarget.blur();
        }
      }}
    />
  );
}

function Wear({ tool }: { tool: Tool }) {
  const deltas = useSignal({ length_wear: "", radius_wear: "" });
  const t = text.value;
  const add = async (field: "length_wear" | "radius_wear", title: string) => {
    const delta = typedNumber(deltas.value[field]);
    if (delta === undefined) return tell(`${title}: ${t.notANumber}`, true);
    const value = Math.round((tool[field] + delta) * 1e9) / 1e9;
    const answer = await change(tool, { ...tool, [field]: value }, `T${tool.number} ${title} ${millimetres(tool[field])} → ${millimetres(value)}`);
    if (!answer.ok) return tell(refusal(title, answer.reason), true);
    deltas.value = { ...deltas.value, [field]: "" };
  };
  return (
    <section class="side-form" aria-label={t.toolDetail(tool.number)}>
      <div class="title"><h2>{t.toolDetail(tool.number)}</h2> <b>{tool.name}</b></div>
      <dl>
        <dt>{t.activeLength}</dt><dd class="digits">{millimetres(tool.length + tool.length_wear)} mm</dd>
        <dt>{t.activeRadius}</dt><dd class="digits">{millimetres(tool.radius + tool.radius_wear)} mm</dd>
      </dl>
      {([["length_wear", t.lengthWear], ["radius_wear", t.radiusWear]] as const).map(([field, title]) => (
        <form
          key={field}
          class="row"
          onSubmit={(event) => {
            event.preventDefault();
            void add(field, title);
          }}
        >
          <input
            class="short digits" inputMode="decimal" placeholder="0" aria-label={t.deltaOf(title)} value={deltas.value[field]}
            onInput={(event) => (deltas.value = { ...deltas.value, [field]: event.currentTarget.value })}
          />
          <button type="submit">{t.addTo(title)}</button>
        </form>
      ))}
      <button
        disabled={tool.number === channel.value?.tool}
        onClick={() =>
          ask(t.deleteToolQuestion(tool.number), t.deleteKey, () => {
            void change(tool, undefined, t.toolDeleted(tool.number)).then((answer) => !answer.ok && tell(refusal(`T${tool.number}`, answer.reason), true));
          })}
      >
        {t.deleteTool(tool.number)}
      </button>
    </section>
  );
}

export function Tools() {
  const revision = machine.value.revisions.tools;
  useEffect(() => void refresh(), [revision]);
  const t = text.value;
  const fields: [Field, string][] = [["length", t.length], ["length_wear", t.lengthWear], ["radius", t.radius], ["radius_wear", t.radiusWear]];
  const one = table.value.tools.find((tool) => tool.number === chosen.value);
  return (
    <>
      <section class="list" aria-label={t.tools}>
        <div class="title">
          <h2>{t.tools}</h2>
          <span class="dim">{t.toolsAbout}</span>
          <div class="end"><Guard needs="setter"><NewTool /></Guard></div>
        </div>
        <div class="scroll">
          <table>
            <thead>
              <tr><th>T</th><th>{t.name}</th>{fields.map(([field, title]) => <th class="right" key={field}>{title}</th>)}</tr>
            </thead>
            <tbody>
              {table.value.tools.map((tool) => (
                <tr key={tool.number} class={tool.number === channel.value?.tool ? "chosen" : ""}>
                  <td><button aria-pressed={tool.number === chosen.value} aria-label={t.toolDetail(tool.number)} onClick={() => (chosen.value = tool.number)}>T{tool.number}</button></td>
                  <td><NameCell tool={tool} /></td>
                  {fields.map(([field, title]) => (
                    <td class="right" key={field}>
                      <Cell
                        value={tool[field]}
                        label={`T${tool.number} ${title}`}
                        store={(value) => change(tool, { ...tool, [field]: value }, `T${tool.number} ${title} ${millimetres(tool[field])} → ${millimetres(value)}`)}
                      />
                    </td>
                  ))}
                </tr>
              ))}
            </tbody>
          </table>
          {table.value.tools.length === 0 && <p class="dim">{t.noTools}</p>}
        </div>
      </section>
      {one ? <Guard needs="setter"><Wear key={one.number} tool={one} /></Guard> : <section class="side-form dim" aria-label={t.tools}>{t.chooseTool}</section>}
    </>
  );
}
