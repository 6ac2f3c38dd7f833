// SPDX-License-Identifier: Apache-2.0
// The tool table.
import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { type Answer, get, put, remove } from "../api";
import type { LifeUnit, Parameter, Tool, ToolTable } from "../contract";
import { fixed, refusal, typedNumber } from "../format";
import { PlcWatch } from "../plc/watch";
import { placeOf, placesOf, tableOf, tableParameter } from "../state/magazine";
import { channel, channelNumber, commandTo, machine, tell } from "../state/store";
import { changeLine, mayChange } from "../state/tool_change";
import { isUsedUp, lifeNumber, lifeText } from "../state/tool_life";
import { changedSince, remember } from "../state/undo";
import { text } from "../text/texts";
import { Cell } from "./Cell";
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

const nothing: PlcWatch["values"]["value"] = new Map();

/** Places of the chosen channel's magazine by T number, live; empty while the PLC does not give them. */
function useMagazine(): ReadonlyMap<number, number> {
  const number = channelNumber.value;
  const hasPlc = machine.value.plc !== undefined;
  const watch = useSignal<PlcWatch | null>(null);
  useEffect(() => {
    if (!hasPlc || number === null) return;
    let wanted = true;
    let opened: PlcWatch | undefined;
    void get<Parameter>(`/api/parameters/${tableParameter(number)}`).then((answer) => {
      const path = tableOf(number, answer.ok ? String(answer.body?.value ?? "") : "");
      if (!wanted || path === "") return;
      opened = new PlcWatch();
      opened.set([path]);
      watch.value = opened;
    });
    return () => {
      wanted = false;
      opened?.close();
      watch.value = null;
    };
  }, [hasPlc, number]);
  return placesOf(watch.value?.values.value ?? nothing);
}

type Field = "length" | "length_wear" | "radius" | "radius_wear";

function NewTool() {
  const number = useSignal("");
  const t = text.value;
  const create = async () => {
    const wanted = typedNumber(number.value);
    if (wanted === undefined || !Number.isInteger(wanted) || wanted < 1) return tell(`${t.toolNumber}: ${t.notANumber}`, true);
    if (table.peek().tools.some((tool) => tool.number === wanted)) return tell(t.toolExists(wanted), true);
    const made: Tool = {
      number: wanted, length: 0, length_wear: 0, radius: 0, radius_wear: 0, name: "", type: "", life_used: 0, life_limit: 0, life_unit: "MINUTES",
    };
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

/** The text is stored when it is left; while it is typed nothing else changes it. */
function TextCell({ tool, field, label, longest }: { tool: Tool; field: "name" | "type"; label: string; longest: number }) {
  const draft = useSignal<string | null>(null);
  const commit = async () => {
    const entered = draft.value;
    if (entered !== null && entered !== tool[field]) {
      const answer = await change(tool, { ...tool, [field]: entered }, `T${tool.number} ${tool[field]} → ${entered}`);
      if (!answer.ok) tell(refusal(label, answer.reason), true);
    }
    draft.value = null;
  };
  return (
    <input
      class="name-cell"
      aria-label={label}
      disabled={lacking("setter") !== ""}
      value={draft.value ?? tool[field]}
      maxLength={longest}
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

/** Orders the change of the chosen channel's tool; what the channel or the gateway refuses is told with its reason. */
async function load(tool: number): Promise<void> {
  const one = channel.peek();
  if (!one) return;
  const t = text.peek();
  const title = t.loadTool(tool);
  if (!mayChange(one)) return tell(`${title}: ${t.notAtRest(one.suspended ? t.stateHELD : t[`state${one.state}`])}`, true);
  if (one.mode !== "MDI" && !(await commandTo(one.channel, title, "mode", { mode: "MDI" }))) return;
  if (await commandTo(one.channel, title, "mdi", { line: changeLine(tool) })) tell(t.loadOrdered(changeLine(tool)), false);
}

function Wear({ tool }: { tool: Tool }) {
  const deltas = useSignal({ length_wear: "", radius_wear: "" });
  const t = text.value;
  const add = async (field: "length_wear" | "radius_wear", title: string) => {
    const delta = typedNumber(deltas.value[field]);
    if (delta === undefined) return tell(`${title}: ${t.notANumber}`, true);
    const value = Math.round((tool[field] + delta) * 1e9) / 1e9;
    const answer = await change(tool, { ...tool, [field]: value }, `T${tool.number} ${title} ${fixed(tool[field])} → ${fixed(value)}`);
    if (!answer.ok) return tell(refusal(title, answer.reason), true);
    deltas.value = { ...deltas.value, [field]: "" };
  };
  return (
    <>
      <dl>
        <dt>{t.activeLength}</dt><dd class="digits">{fixed(tool.length + tool.length_wear)} mm</dd>
        <dt>{t.activeRadius}</dt><dd class="digits">{fixed(tool.radius + tool.radius_wear)} mm</dd>
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
    </>
  );
}

/** What kind of tool it is, how much of its life is used, and at how much it is used up: all of it is entered. */
function TypeAndLife({ tool }: { tool: Tool }) {
  const t = text.value;
  const set = (after: Tool) => change(tool, after, `T${tool.number} ${t.life} ${lifeText(tool, t)} → ${lifeText(after, t)}`);
  const setUnit = async (life_unit: LifeUnit) => {
    const answer = await set({ ...tool, life_unit });
    if (!answer.ok) tell(refusal(t.lifeUnit, answer.reason), true);
  };
  const cell = (field: "life_used" | "life_limit", title: string) => (
    <Cell value={tool[field]} shown={lifeNumber} label={`T${tool.number} ${title}`} store={(value) => set({ ...tool, [field]: value })} />
  );
  return (
    <>
      <dl>
        <dt>{t.toolType}</dt><dd><TextCell tool={tool} field="type" label={`T${tool.number} ${t.toolType}`} longest={32} /></dd>
        <dt>{t.life}</dt><dd class="dim">{t.lifeAbout}</dd>
      </dl>
      <div class="row" role="group" aria-label={t.life}>
        {cell("life_used", t.lifeUsed)}
        {cell("life_limit", t.lifeLimit)}
        <select aria-label={t.lifeUnit} value={tool.life_unit} onChange={(event) => void setUnit(event.currentTarget.value as LifeUnit)}>
          <option value="MINUTES">{t.lifeMinutes}</option>
          <option value="PIECES">{t.lifePieces}</option>
        </select>
      </div>
    </>
  );
}

/** The chosen tool: an operator loads it, a setter changes it. */
function Detail({ tool }: { tool: Tool }) {
  const t = text.value;
  const { number } = tool;
  const inSpindle = number === channel.value?.tool;
  const erase = async () => {
    const answer = await change(tool, undefined, t.toolDeleted(number));
    if (!answer.ok) tell(refusal(`T${number}`, answer.reason), true);
  };
  return (
    <section class="side-form" aria-label={t.toolDetail(number)}>
      <div class="title"><h2>{t.toolDetail(number)}</h2> <b>{tool.name}</b></div>
      <Guard needs="operator">
        <button class="primary" data-test="load-tool" disabled={inSpindle} title={t.loadToolAbout} onClick={() => void load(number)}>{t.loadTool(number)}</button>
      </Guard>
      <Guard needs="setter">
        <Wear tool={tool} />
        <TypeAndLife tool={tool} />
        <button disabled={inSpindle} onClick={() => ask(t.deleteToolQuestion(number), t.deleteKey, () => void erase())}>{t.deleteTool(number)}</button>
      </Guard>
    </section>
  );
}

export function Tools() {
  const revision = machine.value.revisions.tools;
  useEffect(() => void refresh(), [revision]);
  const places = useMagazine();
  const t = text.value;
  const place = (tool: number) => placeOf(tool, channel.value?.tool ?? 0, places);
  const fields: [Field, string][] = [["length", t.length], ["length_wear", t.lengthWear], ["radius", t.radius], ["radius_wear", t.radiusWear]];
  const one = table.value.tools.find((tool) => tool.number === chosen.value);
  return (
    <>
      <section class="list tool-table" aria-label={t.tools}>
        <div class="title">
          <h2>{t.tools}</h2>
          <span class="dim">{t.toolsAbout}</span>
          <div class="end"><Guard needs="setter"><NewTool /></Guard></div>
        </div>
        <div class="scroll">
          <table>
            <thead>
              <tr><th>T</th><th>{t.name}</th><th>{t.toolType}</th><th>{t.magazinePlace}</th><th title={t.lifeAbout}>{t.life}</th>{fields.map(([field, title]) => <th class="right" key={field}>{title}</th>)}</tr>
            </thead>
            <tbody>
              {table.value.tools.map((tool) => (
                <tr key={tool.number} class={tool.number === channel.value?.tool ? "chosen" : ""}>
                  <td><button aria-pressed={tool.number === chosen.value} aria-label={t.toolDetail(tool.number)} onClick={() => (chosen.value = tool.number)}>T{tool.number}</button></td>
                  <td><TextCell tool={tool} field="name" label={t.toolName(tool.number)} longest={64} /></td>
                  <td>{tool.type}</td>
                  <td data-test={`place-${tool.number}`}>{place(tool.number) === 0 ? t.spindlePlace : (place(tool.number) ?? "–")}</td>
                  <td data-test={`life-${tool.number}`}><span class={isUsedUp(tool) ? "tag warn" : ""}>{lifeText(tool, t)}</span></td>
                  {fields.map(([field, title]) => (
                    <td class="right" key={field}>
                      <Cell
                        value={tool[field]}
                        label={`T${tool.number} ${title}`}
                        store={(value) => change(tool, { ...tool, [field]: value }, `T${tool.number} ${title} ${fixed(tool[field])} → ${fixed(value)}`)}
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
      {one ? <Detail key={one.number} tool={one} /> : <section class="side-form dim" aria-label={t.tools}>{t.chooseTool}</section>}
    </>
  );
}
