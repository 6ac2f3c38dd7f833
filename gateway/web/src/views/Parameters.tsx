// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { get, type Parameter, utf8 } from "../api";
import { limits, title, unit } from "../format";
import { compareWithDefaults, compareWithFile, parseParameters, sixDigits, writeParameters } from "../state/parameter_file";
import { machine, tell } from "../state/store";
import { text } from "../text/texts";
import { GuardNote } from "./Guard";
import { allParameters, type Comparison, ParameterComparison } from "./ParameterComparison";
import { ParameterEditor } from "./ParameterEditor";
import { type Branch, ParameterTree } from "./ParameterTree";
import { UndoKey } from "./UndoKey";

/** Rows that are drawn; more are found by a search. */
const mostRows = 400;

function download(name: string, content: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type: "application/yaml" }));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

function Rows({ found, chosen, choose }: { found: Parameter[]; chosen: number | null; choose: (number: number) => void }) {
  const t = text.value;
  return (
    <table>
      <thead>
        <tr><th>{t.number}</th><th>{t.name}</th><th class="right">{t.value}</th><th>{t.unit}</th><th>{t.limits}</th><th>{t.effect}</th></tr>
      </thead>
      <tbody>
        {found.map((parameter) => (
          <tr
            key={parameter.number}
            tabIndex={0}
            aria-selected={parameter.number === chosen}
            data-parameter={sixDigits(parameter.number)}
            onClick={() => choose(parameter.number)}
            onFocus={() => choose(parameter.number)}
          >
            <td class="digits">{sixDigits(parameter.number)}</td>
            <td>{title(parameter.name)}</td>
            <td class={`right digits ${parameter.value === parameter.default ? "" : "changed"}`}>{parameter.value}</td>
            <td class="dim">{unit(parameter.unit, t.or)}</td>
            <td class="dim digits">{limits(parameter.minimum, parameter.maximum)}</td>
            <td>{parameter.activation}{parameter.pending && <span class="tag warn">{t.waits(String(parameter.pending_value))}</span>}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function Parameters() {
  const search = useSignal("");
  const branch = useSignal<Branch>({ group: "", unit: null });
  const found = useSignal<Parameter[]>([]);
  const total = useSignal(0);
  const problem = useSignal("");
  const chosen = useSignal<number | null>(null);
  const edited = useSignal<Parameter | null>(null);
  const comparison = useSignal<Comparison | null>(null);
  const file = useRef<HTMLInputElement>(null);
  const asked = useRef(0);
  const { parameters: revision, pending } = machine.value.revisions;
  const t = text.value;

  const load = async () => {
    const mine = ++asked.current;
    const { group, unit: thousands } = branch.value;
    // A unit is a part of its class, and only the whole class can be asked for.
    const query = new URLSearchParams({ limit: String(thousands === null ? mostRows : 20000) });
    if (group) query.set("class", group);
    if (search.value.trim()) query.set("search", search.value.trim());
    const answer = await get<{ parameters: Parameter[]; total: number }>(`/api/parameters?${query.toString()}`);
    if (mine !== asked.current) return;
    problem.value = answer.reason;
    if (!answer.ok || !answer.body) return;
    const wanted = answer.body.parameters.filter(({ number }) => thousands === null || Math.floor(number / 1000) === thousands);
    found.value = wanted.slice(0, mostRows);
    total.value = thousands === null ? answer.body.total : wanted.length;
  };
  useEffect(() => {
    const timer = setTimeout(() => void load(), 120);
    return () => clearTimeout(timer);
  }, [search.value, branch.value, revision, pending]);
  useEffect(() => {
    const number = chosen.value;
    if (number === null) return;
    void get<Parameter>(`/api/parameters/${sixDigits(number)}`).then((answer) => {
      if (answer.body && chosen.peek() === number) edited.value = answer.body;
    });
  }, [chosen.value, revision, pending]);

  const compareDefaults = async () => {
    const all = await allParameters();
    if (all) comparison.value = { what: t.theDefaults, rows: compareWithDefaults(all), bad: [], takeable: false };
  };
  const compareFile = async (chosenFile: File) => {
    const content = utf8(await chosenFile.arrayBuffer());
    if (content === null) return tell(t.notText(chosenFile.name), true);
    const all = await allParameters();
    if (!all) return;
    const read = parseParameters(content);
    comparison.value = { what: chosenFile.name, rows: compareWithFile(all, read), bad: read.bad, takeable: true };
  };
  const exportAll = async () => {
    const all = await allParameters();
    if (all) download(`${machine.peek().cluster?.machine || "machine"}.parameters.yaml`, writeParameters(all, false));
  };
  /** A comparison is that of the moment; what was stored since is compared anew. */
  const again = async () => {
    comparison.value = null;
    await load();
  };

  return (
    <main class="parameters">
      <section class="setup-keys" aria-label={t.parameterFiles}>
        <button aria-pressed={comparison.value?.what === t.theDefaults} onClick={() => void compareDefaults()}>{t.compareDefaults}</button>
        <button onClick={() => file.current?.click()}>{t.importFile}</button>
        <input
          ref={file}
          type="file"
          hidden
          aria-label={t.importFile}
          onChange={(event) => {
            const first = event.currentTarget.files?.[0];
            event.currentTarget.value = "";
            if (first) void compareFile(first);
          }}
        />
        <button title={t.exportAbout} onClick={() => void exportAll()}>{t.exportFile}</button>
        <UndoKey />
        <GuardNote needs="setter" />
      </section>
      <ParameterTree
        chosen={branch.value}
        choose={(next) => {
          branch.value = next;
          comparison.value = null;
        }}
      />
      {comparison.value ? (
        <ParameterComparison comparison={comparison.value} choose={(number) => (chosen.value = number)} done={() => void again()} close={() => (comparison.value = null)} />
      ) : (
        <section class="list" aria-label={t.parameters}>
          <div class="title">
            <input
              type="search"
              autofocus
              data-test="parameter-search"
              placeholder={t.numberNameHelp}
              aria-label={t.numberNameHelp}
              value={search.value}
              onInput={(event) => (search.value = event.currentTarget.value)}
            />
            <span class="dim end">
              {found.value.length < total.value ? t.shownOf(found.value.length, total.value) : total.value}
              {pending ? ` · ${t.pending(pending)}` : ""}
            </span>
          </div>
          <div class="scroll">
            <Rows found={found.value} chosen={chosen.value} choose={(number) => (chosen.value = number)} />
            {problem.value && <p class="refusal">{problem.value}</p>}
            {!problem.value && found.value.length === 0 && <p class="dim">{t.nothingFound}</p>}
          </div>
        </section>
      )}
      {edited.value ? (
        <ParameterEditor key={edited.value.number} parameter={edited.value} done={() => void load()} />
      ) : (
        <section class="editor dim">{t.chooseParameter}</section>
      )}
    </main>
  );
}
