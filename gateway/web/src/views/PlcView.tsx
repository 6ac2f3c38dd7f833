// SPDX-License-Identifier: Apache-2.0
// The programs of the PLC while they run: sources with live values, variables, forced values, a trace.
import { signal, useSignal } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { get, post } from "../api";
import type { PlcForces, PlcPrograms, PlcVariable, PlcVariableList } from "../contract";
import { declared, listProgram, Paths, sourceLines } from "../plc/source";
import { type Live, PlcWatch } from "../plc/watch";
import { tell } from "../state/store";
import { text } from "../text/texts";
import { Guard, GuardNote } from "./Guard";
import { PlcDiagram } from "./PlcDiagram";
import { PlcLoad } from "./PlcLoad";
import { PlcTools } from "./PlcTools";
import { ask } from "./Question";

const mostShown = 100;
/** The list is read whole for the sources; the PLC has at most 4096 cells. */
const mostListed = 1000;
const forcePeriod = 1000;  // ms

const chosen = signal<string[]>([]);

const problemOf = (answer: { reason: string }) => tell(answer.reason, true);

async function allVariables(): Promise<PlcVariable[]> {
  const all: PlcVariable[] = [];
  for (;;) {
    const answer = await get<PlcVariableList>(`/api/plc/variables?offset=${all.length}&limit=${mostListed}`);
    if (!answer.body?.variables) {
      problemOf(answer);
      return all;
    }
    all.push(...answer.body.variables);
    if (all.length >= answer.body.total || answer.body.variables.length === 0) return all;
  }
}

function Source({ programs, paths, live, watch }: { programs: PlcPrograms; paths: Paths; live: ReadonlyMap<string, Live>; watch: (paths: string[]) => void }) {
  const file = useSignal(programs.files.find(({ name }) => name === "main.st")?.name ?? programs.files[0]?.name ?? "");
  const content = useSignal("");
  const instance = useSignal("");
  const place = useRef<HTMLDivElement>(null);
  const top = useSignal(0);
  const t = text.value;
  useEffect(() => {
    const name = file.value;
    void fetch(`/api/plc/programs/${encodeURIComponent(name)}`).then(async (answer) => {
      if (answer.ok && file.peek() === name) content.value = await answer.text();
    });
    instance.value = "";
  }, [file.value, programs.crc32]);
  const drawn = useSignal(true);
  const isDrawn = drawn.value && file.value.endsWith(".xml");
  const lines = useMemo(() => sourceLines(content.value, listProgram(file.value)), [content.value, file.value]);
  // Of each unit the prefixes of its variables; one that is a program of its own name needs no choice.
  const prefixes = useMemo(
    () => new Map(lines.filter(({ kind }) => kind !== "").map(({ kind, unit }) => [unit, kind] as const)
      .map(([unit, kind]) => [unit, paths.prefixes(kind === "PROGRAM" ? unit : "", declared(content.value, unit))] as const)),
    [lines, paths],
  );
  const blocks = [...prefixes].flatMap(([unit, list]) => (list.length === 1 && list[0] === unit ? [] : list));
  const prefix = (unit: string) => {
    const list = prefixes.get(unit) ?? [];
    return list.includes(instance.value) ? instance.value : (list[0] ?? "");
  };
  const named = useMemo(
    () => lines.map((line) => [...new Set(line.names.flatMap((name) => paths.find(name, prefix(line.unit)) ?? []))]),
    [lines, paths, instance.value, prefixes],
  );
  const height = 24;  // px of a line, as in the style sheet
  const first = Math.max(0, Math.floor(top.value / height) - 4);
  const last = first + 60;
  const wanted = named.slice(first, last).flat();
  useEffect(() => {
    if (!isDrawn) watch(wanted);
  }, [wanted.join(" "), isDrawn]);
  return (
    <section class="plc-source" aria-label={t.plcSource}>
      <div class="title">
        <h2>{t.plcSource}</h2>
        <select aria-label={t.plcFile} value={file.value} onChange={(event) => (file.value = event.currentTarget.value)}>
          {programs.files.map(({ name }) => <option key={name}>{name}</option>)}
        </select>
        {file.value.endsWith(".xml") && (
          <button aria-pressed={drawn.value} onClick={() => (drawn.value = !drawn.value)}>{t.plcDrawing}</button>
        )}
        {!isDrawn && blocks.length > 0 && (
          <select aria-label={t.plcInstance} value={instance.value || blocks[0]} onChange={(event) => (instance.value = event.currentTarget.value)}>
            {blocks.map((name) => <option key={name}>{name}</option>)}
          </select>
        )}
        <span class="dim">{programs.delivered ? t.plcDelivered : t.plcLoadedOnline(programs.changes)}</span>
      </div>
      {isDrawn ? <PlcDiagram source={content.value} paths={paths} live={live} watch={watch} /> : <div class="plc-code" ref={place} tabIndex={0} role="region" aria-label={file.value} onScroll={(event) => (top.value = event.currentTarget.scrollTop)}>
        {lines.map((line, index) => (
          <div class="plc-line" key={index}>
            <span class="dim digits">{index + 1}</span>
            <code>{line.text}</code>
            {index >= first && index < last && (
              <span class="plc-values">
                {named[index]!.flatMap((path) => {
                  const one = live.get(path);
                  return one ? [<Value key={path} path={path} live={one} />] : [];
                })}
              </span>
            )}
          </div>
        ))}
      </div>}
    </section>
  );
}

function Value({ path, live }: { path: string; live: Live }) {
  const short = path.slice(path.lastIndexOf(".") + 1);
  return (
    <span class={`plc-value ${live.forced ? "forced" : live.value === "TRUE" ? "set" : ""}`} title={path} data-path={path}>
      {path.startsWith("%") ? path : short} = {live.value}{live.variable.unit ? ` ${live.variable.unit}` : ""}
      {live.forced && <b> {text.value.plcForced}</b>}
    </span>
  );
}

function Watched({ live, forces }: { live: ReadonlyMap<string, Live>; forces: PlcForces | null }) {
  const t = text.value;
  const typed = useSignal<Record<string, string>>({});
  const forced = new Set(forces?.values.map(({ path }) => path.toUpperCase()));
  const release = (paths: string[]) => void post("/api/plc/release", paths.length > 0 ? { paths } : {}).then((answer) => !answer.ok && problemOf(answer));
  const force = (path: string) => {
    const value = typed.value[path] ?? "";
    if (value.trim() === "") return;
    ask(t.plcForceQuestion(path, value), t.plcForce, () => {
      void post("/api/plc/force", { values: [{ path, value }] }).then((answer) => {
        if (!answer.ok) return problemOf(answer);
        typed.value = { ...typed.value, [path]: "" };
      });
    });
  };
  const others = forces?.values.filter(({ path }) => !chosen.value.some((one) => one.toUpperCase() === path.toUpperCase())) ?? [];
  const rows = [...chosen.value, ...others.map(({ path }) => path)];
  return (
    <section class="plc-watched" aria-label={t.plcWatched}>
      <div class="title">
        <h2>{t.plcWatched}</h2>
        {forced.size > 0 && <span class="tag warn" data-test="plc-forces">{t.plcForces(forced.size)}</span>}
        <div class="end"><Guard needs="builder"><button disabled={forced.size === 0} onClick={() => release([])}>{t.plcReleaseAll}</button></Guard></div>
      </div>
      <GuardNote needs="builder" />
      <div class="scroll" tabIndex={0} role="region" aria-label={t.plcWatched}>
        {rows.length === 0 && <p class="dim">{t.plcNothingWatched}</p>}
        <table>
          <tbody>
            {rows.map((path) => {
              const one = live.get(path);
              const is = forced.has(path.toUpperCase()) || (one?.forced ?? false);
              return (
                <tr key={path} class={is ? "forced" : ""}>
                  <td>{path} <span class="dim">{one?.variable.type}</span></td>
                  <td class="right digits">{one?.value ?? "–"} {one?.variable.unit}</td>
                  <td>{is && <span class="tag warn">{t.plcForced}</span>}</td>
                  <td>
                    <Guard needs="builder">
                      <form
                        class="row"
                        onSubmit={(event) => {
                          event.preventDefault();
                          force(path);
                        }}
                      >
                        <input
                          class="short digits" aria-label={t.plcForceValue(path)} value={typed.value[path] ?? ""}
                          onInput={(event) => (typed.value = { ...typed.value, [path]: event.currentTarget.value })}
                        />
                        <button type="submit">{t.plcForce}</button>
                        <button type="button" aria-label={t.plcRelease(path)} disabled={!is} onClick={() => release([path])}>✕</button>
                      </form>
                    </Guard>
                  </td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function VariableList({ variables }: { variables: PlcVariable[] }) {
  const t = text.value;
  const search = useSignal("");
  const wanted = search.value.trim().toUpperCase();
  const found = variables.filter(({ path }) => path.toUpperCase().includes(wanted));
  const toggle = (path: string) =>
    (chosen.value = chosen.value.includes(path) ? chosen.value.filter((one) => one !== path) : [...chosen.value, path]);
  // A register is not in the list of the programs' variables.
  const register = /^%[A-Z]+\d+(\.\d+)?$/.test(wanted) ? [{ path: wanted, type: "", retained: false }] : [];
  const shown = [...register, ...found.slice(0, mostShown)];
  return (
    <section class="plc-list" aria-label={t.plcVariables}>
      <div class="title">
        <input type="search" aria-label={t.plcFind} placeholder={t.plcFind} value={search.value} onInput={(event) => (search.value = event.currentTarget.value)} />
        <span class="dim end">{t.plcFound(shown.length, found.length + register.length)}</span>
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.plcVariables}>
        {shown.map(({ path, type }) => (
          <button key={path} class="choose" aria-pressed={chosen.value.includes(path)} aria-label={t.plcWatch(type ? `${path} ${type}` : path)} onClick={() => toggle(path)}>
            <b>{path}</b> <span class="dim">{type}</span>
          </button>
        ))}
      </div>
    </section>
  );
}

export function PlcView({ close }: { close: () => void }) {
  const t = text.value;
  const programs = useSignal<PlcPrograms | null>(null);
  const variables = useSignal<PlcVariable[]>([]);
  const forces = useSignal<PlcForces | null>(null);
  const problem = useSignal("");
  const shownInSource = useSignal<string[]>([]);
  const shownInTools = useSignal<string[]>([]);
  const changes = useSignal(false);
  const watch = useMemo(() => new PlcWatch(), []);
  useEffect(() => () => watch.close(), []);
  useEffect(() => {
    const look = async () => {
      const [running, forced] = await Promise.all([get<PlcPrograms>("/api/plc/programs"), get<PlcForces>("/api/plc/forces")]);
      problem.value = running.reason;
      if (forced.body?.values) forces.value = forced.body;
      const before = programs.peek();
      if (!running.body?.files || (before?.crc32 === running.body.crc32 && before.changes === running.body.changes)) return;
      programs.value = running.body;
      variables.value = await allVariables();
    };
    void look();
    const timer = setInterval(() => void look(), forcePeriod);
    return () => clearInterval(timer);
  }, []);
  const all = useMemo(() => variables.value.map(({ path }) => path), [variables.value]);
  const paths = useMemo(() => new Paths(all), [all]);
  const forcedPaths = forces.value?.values.map(({ path }) => path) ?? [];
  const wanted = [...chosen.value, ...forcedPaths, ...shownInTools.value, ...shownInSource.value];
  useEffect(() => watch.set(wanted), [wanted.join(" ")]);
  const live = watch.values.value;
  return (
    <main class="plc-view">
      <section class="setup-keys" aria-label={t.plcPrograms}>
        <button onClick={close}>{t.plcBack}</button>
        <h2>{t.plcPrograms}</h2>
        <button aria-pressed={changes.value} disabled={!programs.value} onClick={() => (changes.value = !changes.value)}>{t.plcLoad}</button>
        {(problem.value || watch.problem.value) && <span class="refusal" role="status">{problem.value || watch.problem.value}</span>}
      </section>
      {programs.value && changes.value ? (
        <PlcLoad programs={programs.value} close={() => (changes.value = false)} />
      ) : programs.value ? (
        <Source programs={programs.value} paths={paths} live={live} watch={(list) => (shownInSource.value = list)} />
      ) : (
        <section class="plc-source dim" aria-label={t.plcSource}>{t.loading}</section>
      )}
      <VariableList variables={variables.value} />
      {!changes.value && <Watched live={live} forces={forces.value} />}
      {programs.value && (
        <PlcTools chosen={chosen.value} programs={programs.value} all={all} live={live} watch={(list) => (shownInTools.value = list)} />
      )}
    </main>
  );
}
