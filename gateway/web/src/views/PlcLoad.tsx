// SPDX-License-Identifier: Apache-2.0
// New programs into the running PLC: files chosen and edited, checked, compared on standby, taken over or dropped.
import { useSignal } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { get, post, remove } from "../api";
import type { PlcLoad as Load, PlcPrograms } from "../contract";
import { isSource, messageOf, runningSources, type SourceFile, stateOf, withFile } from "../plc/load";
import type { ProgramEditor } from "../program/editor";
import { phrases } from "../program/phrases";
import { language } from "../state/preferences";
import { tell } from "../state/store";
import { text } from "../text/texts";
import { Guard, GuardNote } from "./Guard";
import { ask } from "./Question";

const period = 200;  // ms between two questions
const comparedFor = 1000;  // scans until a take-over is offered

function Editor({ file, label, changed, place }: { file: SourceFile; label: string; changed: (text: string) => void; place: { line: number; column: number; text: string } | undefined }) {
  const element = useRef<HTMLDivElement>(null);
  const editor = useRef<ProgramEditor>();
  const mark = () => {
    editor.current?.mark(place && { ...place, number: 0 });
    if (place) editor.current?.goTo(place.line);
  };
  useEffect(() => {
    let ended = false;
    void Promise.all([import("../program/editor"), import("../plc/structured_text")]).then(([{ ProgramEditor: Made }, { languageOf }]) => {
      if (ended || !element.current) return;
      const made = new Made(element.current, file.text, label, phrases[language.peek()], { changed: () => changed(made.text), line: () => undefined }, languageOf(file.name));
      editor.current = made;
      mark();
    });
    return () => {
      ended = true;
      editor.current?.destroy();
      editor.current = undefined;
    };
  }, [file.name]);
  useEffect(mark, [place?.line, place?.column, place?.text]);
  return <div class="editor-place" ref={element} />;
}

export function PlcLoad({ programs, close }: { programs: PlcPrograms; close: () => void }) {
  const t = text.value;
  const files = useSignal<SourceFile[]>([]);
  const shown = useSignal("");
  const load = useSignal<Load | null>(null);
  const place = useSignal<{ file: string; line: number; column: number; text: string } | undefined>(undefined);
  const accepts = useSignal(false);
  const busy = useSignal(false);
  /** Counts what is chosen: the editor begins again with another text. */
  const chosen = useSignal(0);
  const chooser = useRef<HTMLInputElement>(null);
  const phase = load.value?.phase ?? "NO_LOAD";

  useEffect(() => {
    void runningSources(programs).then((found) => {
      files.value = found.map((file) => ({ ...file, running: file.text }));
      if (!found.some(({ name }) => name === shown.peek())) shown.value = found.find(({ name }) => name === "main.st")?.name ?? found[0]?.name ?? "";
    });
  }, [programs.crc32, programs.changes]);
  useEffect(() => {
    if (phase !== "COMPILING" && phase !== "COMPARING") return;
    const timer = setInterval(() => {
      void get<Load>("/api/plc/load").then((answer) => {
        if (answer.body?.phase) load.value = answer.body;
      });
    }, period);
    return () => clearInterval(timer);
  }, [phase]);
  useEffect(() => () => {
    if (load.peek()) void remove("/api/plc/load");
  }, []);

  const drop = () => {
    if (load.peek()) void remove("/api/plc/load");
    load.value = null;
    place.value = undefined;
    accepts.value = false;
  };
  const begin = async (body: object) => {
    busy.value = true;
    drop();
    const answer = await post("/api/plc/load", body);
    busy.value = false;
    if (!answer.ok) return tell(answer.reason, true);
    load.value = { phase: "COMPILING", compared: 0, differences: 0, messages: [] };
  };
  const compare = async () => {
    const answer = await post("/api/plc/load/compare");
    if (!answer.ok) return tell(answer.reason, true);
    if (load.value) load.value = { ...load.value, phase: "COMPARING" };
  };
  const takeOver = () =>
    ask(t.plcTakeOverQuestion, t.plcTakeOver, () => {
      void post("/api/plc/load/take-over", { accept_differences: accepts.value }).then((answer) => {
        if (!answer.ok) return tell(answer.reason, true);
        load.value = null;
        tell(t.plcTakenOver, false);
        close();
      });
    });
  const choose = async (list: FileList) => {
    for (const file of list) {
      if (!isSource(file.name)) {
        tell(t.plcNoSource(file.name), true);
        continue;
      }
      files.value = withFile(files.value, file.name, await file.text());
      shown.value = file.name;
    }
    chosen.value += 1;
    drop();
  };
  const messages = useMemo(() => (load.value?.messages ?? []).map(messageOf), [load.value?.messages]);
  const one = files.value.find(({ name }) => name === shown.value);
  const states = { same: "", changed: ` – ${t.plcFileChanged}`, new: ` – ${t.plcFileNew}` };
  const compared = load.value?.compared ?? 0;
  const differences = load.value?.differences ?? 0;
  return (
    <section class="plc-load" aria-label={t.plcLoad}>
      <div class="title">
        <select aria-label={t.plcFile} value={shown.value} onChange={(event) => (shown.value = event.currentTarget.value)}>
          {files.value.map((file) => <option key={file.name} value={file.name}>{file.name}{states[stateOf(file)]}</option>)}
        </select>
        <button onClick={() => chooser.current?.click()}>{t.plcChooseFiles}</button>
        <input
          ref={chooser} type="file" hidden multiple accept=".st,.exp,.xml,.il,.yaml" aria-label={t.plcChooseFiles}
          onChange={(event) => {
            if (event.currentTarget.files) void choose(event.currentTarget.files);
          }}
        />
        <button
          disabled={!one || files.value.length < 2}
          onClick={() => {
            files.value = files.value.filter(({ name }) => name !== shown.value);
            shown.value = files.value[0]?.name ?? "";
            drop();
          }}
        >
          {t.plcRemoveFile}
        </button>
        <div class="end"><button onClick={() => { drop(); close(); }}>{t.plcEndLoad}</button></div>
      </div>
      {one && (
        <Editor
          key={`${one.name} ${chosen.value}`} file={one} label={one.name}
          place={place.value?.file === one.name ? place.value : undefined}
          changed={(content) => {
            files.value = withFile(files.value, one.name, content);
            if (load.peek()) drop();
          }}
        />
      )}
      <Guard needs="builder">
        <div class="row">
          <button disabled={busy.value || files.value.length === 0} onClick={() => void begin({ files: files.value.map(({ name, text: content }) => ({ name, text: content })) })}>{t.plcCheck}</button>
          <button disabled={phase !== "COMPILED"} onClick={() => void compare()}>{t.plcCompare}</button>
          <button class="primary" disabled={phase !== "COMPARING" || (differences > 0 && !accepts.value)} onClick={takeOver}>{t.plcTakeOver}</button>
          <button disabled={busy.value || programs.changes === 0} onClick={() => void begin({ undo: true })}>{t.plcUndoLoad}</button>
        </div>
      </Guard>
      <GuardNote needs="builder" />
      <div class="plc-messages scroll" tabIndex={0} role="region" aria-label={t.plcMessages}>
        <p role="status" data-test="plc-load-state">
          {phase === "NO_LOAD" && t.plcLoadAbout}
          {phase === "COMPILING" && t.checking}
          {phase === "WITH_ERRORS" && t.plcWithErrors}
          {phase === "COMPILED" && (messages.length > 0 ? t.plcReadBefore : t.plcAllKept)}
          {phase === "COMPARING" && t.plcComparing(compared, differences)}
        </p>
        {phase === "COMPARING" && <progress max={comparedFor} value={Math.min(compared, comparedFor)} aria-label={t.plcCompare} />}
        {messages.map((message, index) =>
          message.file && files.value.some(({ name }) => name === message.file) ? (
            <button
              key={index} class={message.kind === "error" ? "check-error" : "choose"}
              onClick={() => {
                shown.value = message.file;
                place.value = { ...message };
              }}
            >
              <b>{message.file}:{message.line}:{message.column}</b> {message.text}
            </button>
          ) : (
            <p key={index} class={message.kind === "error" ? "refusal" : ""}>{message.text}</p>
          ),
        )}
        {phase === "COMPARING" && differences > 0 && (
          <label class="row"><input type="checkbox" checked={accepts.value} onChange={(event) => (accepts.value = event.currentTarget.checked)} /> {t.plcAcceptDifferences}</label>
        )}
      </div>
    </section>
  );
}
