// SPDX-License-Identifier: Apache-2.0
// One program being edited: text, errors of the check, comparison, outline and path.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { checkProgram, post, programText, storeProgram, utf8 } from "../api";
import type { ProgramPath } from "../contract";
import { refusal } from "../format";
import { Checker, type CheckState } from "../program/check";
import type { Drafts } from "../program/drafts";
import type { ProgramEditor } from "../program/editor";
import { isProgramName } from "../program/folders";
import { outline, type OutlineEntry } from "../program/outline";
import { phrases } from "../program/phrases";
import { language } from "../state/preferences";
import { programs, refreshPrograms, removeProgram } from "../state/programs";
import { channel, channelNumber, command, tell } from "../state/store";
import { text } from "../text/texts";
import { PathPreview } from "./PathPreview";
import { lacking, lackingToStore } from "./Guard";
import { ask } from "./Question";

export interface OpenProgram {
  name: string;
  /** Revision that the text was made of; 0: the program is new. */
  revision: number;
  /** The text of that revision. */
  stored: string;
  /** What is shown first: the stored text, or what was not saved. */
  text: string;
}

interface Props {
  program: OpenProgram;
  drafts: Drafts;
  /** Something was kept or saved; with a program that is open from now on, or null for none. */
  changed: (next?: OpenProgram | null) => void;
}

function CheckLine({ state, goTo }: { state: CheckState; goTo: (line: number) => void }) {
  const t = text.value;
  if (state.kind === "failed") return <span class="dim">{t.notChecked(state.reason)}</span>;
  if (state.kind !== "done")
    return <span class="dim">{state.kind === "checking" ? t.checking : state.kind === "too-large" ? t.tooLargeToCheck : ""}</span>;
  const { error, complete, blocks, moves } = state.result;
  if (!error) return <span class={complete ? "good-text" : "dim"}>{complete ? t.noErrors(blocks, moves) : t.checkNotComplete(blocks)}</span>;
  const inside = error.program ? ` ${t.inSubprogram(error.program, error.program_line ?? 0)}` : "";
  return (
    <button class="check-error" data-test="check-error" onClick={() => goTo(error.line)}>
      <b>{t.errorPlace(error.line, error.column)}</b> {error.number}: {error.text}{inside}
    </button>
  );
}

function Rename({ name, done }: { name: string; done: (name: string) => void }) {
  const wanted = useSignal(name);
  const t = text.value;
  return (
    <form
      class="row"
      aria-label={t.rename}
      onSubmit={(event) => {
        event.preventDefault();
        if (!isProgramName(wanted.value)) return tell(t.badName, true);
        void post(`/api/programs/${encodeURIComponent(name)}/rename`, { name: wanted.value }).then((answer) => {
          if (answer.ok) done(wanted.value);
          else tell(`${t.rename} ${answer.reason}`, true);
        });
      }}
    >
      <input aria-label={t.newNameOf(name)} value={wanted.value} autofocus onInput={(event) => (wanted.value = event.currentTarget.value)} />
      <button type="submit" class="primary">{t.renameKey}</button>
    </form>
  );
}

export function EditorPane({ program, drafts, changed }: Props) {
  const place = useRef<HTMLDivElement>(null);
  const editor = useRef<ProgramEditor | undefined>(undefined);
  const file = useRef<HTMLInputElement>(null);
  const current = useRef(program);
  current.current = program;
  const dirty = useSignal(program.text !== program.stored || program.revision === 0);
  const check = useSignal<CheckState>({ kind: "none" });
  const entries = useSignal<OutlineEntry[]>([]);
  const path = useSignal<ProgramPath | null>(null);
  const line = useSignal(1);
  const side = useSignal<"outline" | "path">("outline");
  const renaming = useSignal(false);
  const compared = useSignal<{ what: string; differences: number } | null>(null);
  const t = text.value;
  const { name } = program;

  useEffect(() => {
    let ended = false;
    let made: ProgramEditor | undefined;
    let pending: ReturnType<typeof setTimeout> | undefined;
    const checker = new Checker(
      (content) => checkProgram(channelNumber.peek() ?? 0, content, current.current.name),
      (state) => {
        check.value = state;
        if (state.kind !== "done") return;
        path.value = state.result.path;
        made?.written(state.result.dialect);
        made?.mark(state.result.error);
      },
    );
    /** Keeps what is not saved. */
    const keep = () => {
      clearTimeout(pending);
      pending = undefined;
      if (!made) return;
      const now = current.current;
      const content = made.text;
      dirty.value = content !== now.stored || now.revision === 0;
      if (dirty.value) {
        if (!drafts.keep(now.name, { revision: now.revision, text: content })) tell(text.peek().keptByPageOnly(now.name), true);
      } else drafts.drop(now.name);
      entries.value = outline(made.lines());
      changed();
    };
    const flush = () => pending !== undefined && keep();
    void import("../program/editor").then(({ ProgramEditor: Editor }) => {
      if (ended || !place.current) return;
      made = new Editor(place.current, current.current.text, text.peek().textOf(name), phrases[language.peek()], {
        changed: () => {
          clearTimeout(pending);
          pending = setTimeout(keep, 200);
          checker.changed(() => made!.text);
          if (compared.peek()) compared.value = { ...compared.peek()!, differences: made!.differences };
        },
        line: (number) => (line.value = number),
      });
      editor.current = made;
      entries.value = outline(made.lines());
      checker.changed(() => made!.text);
    });
    window.addEventListener("pagehide", flush);
    return () => {
      flush();
      ended = true;
      checker.stop();
      window.removeEventListener("pagehide", flush);
      made?.destroy();
      editor.current = undefined;
    };
  }, [name]);

  const saveOn = async (revision: number): Promise<void> => {
    const content = editor.current?.text;
    if (content === undefined) return;
    const answer = await storeProgram(name, content, revision);
    if (answer.status === 412) {
      const newest = await programText(name);
      ask(t.changedMeanwhile(name, newest?.revision ?? 0), t.replaceKey, () => void saveOn(newest?.revision ?? 0));
      return;
    }
    if (!answer.ok || !answer.body) return tell(refusal(t.save, answer.reason), true);
    tell(t.stored(name), false);
    // Typing goes on while the answer is on its way.
    const saved = { name, revision: answer.body.program.revision, stored: content, text: content };
    current.current = saved;
    const now = editor.current?.text ?? content;
    dirty.value = now !== content;
    if (dirty.value) drafts.keep(name, { revision: saved.revision, text: now });
    else drafts.drop(name);
    changed(saved);
    await refreshPrograms();
  };
  const save = () => void saveOn(program.revision);

  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.key !== "s" || !event.ctrlKey) return;
      event.preventDefault();
      void saveOn(current.current.revision);
    };
    window.addEventListener("keydown", onKey);
    return () => window.removeEventListener("keydown", onKey);
  });

  const compareWith = (what: string, original: string) => {
    editor.current?.compare(original);
    compared.value = { what, differences: editor.current?.differences ?? 0 };
  };
  const compareNamed = async (other: string) => {
    const found = await programText(other);
    if (found?.text == null) tell(t.notRead(other), true);
    else compareWith(t.revisionOf(other, found.revision), found.text);
  };
  const download = () => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([editor.current?.text ?? ""], { type: "text/plain" }));
    link.download = name;
    link.click();
    URL.revokeObjectURL(link.href);
  };
  const discard = () =>
    ask(t.discardQuestion(name), t.discard, () => {
      drafts.drop(name);
      if (program.revision === 0) return changed(null);
      void programText(name).then((newest) => {
        if (newest?.text == null) return tell(t.notRead(name), true);
        changed({ name, revision: newest.revision, stored: newest.text, text: newest.text });
        current.current = { ...current.current, revision: newest.revision, stored: newest.text };
        editor.current?.replace(newest.text);
      });
    });

  const selected = channel.value?.program === name;
  const newest = programs.value.find((one) => one.name === name);
  return (
    <>
      <section class="editor-pane" aria-label={t.programText}>
        <div class="title">
          <b class="name">{name}</b>
          <span class="dim">{program.revision > 0 ? t.revision(program.revision) : t.newHere}</span>
          {dirty.value && <span class="tag warn" data-test="not-saved">{t.notSaved}</span>}
          {selected && <span class="tag note">{t.selectedProgram}</span>}
          {newest && newest.revision !== program.revision && <span class="tag bad">{t.revisionIsStored(newest.revision)}</span>}
        </div>
        <div class="title tools">
          <button class="primary" title="Ctrl+S" disabled={!dirty.value || lackingToStore() !== ""} onClick={save}>{t.save}</button>
          <button disabled={!dirty.value && newest?.revision === program.revision} onClick={discard}>{t.discard}</button>
          <button title="Ctrl+F" onClick={() => editor.current?.find()}>{t.find}</button>
          <select
            aria-label={t.compareWith}
            value=""
            onChange={(event) => {
              const chosen = event.currentTarget.value;
              event.currentTarget.value = "";
              if (chosen === "file") file.current?.click();
              else if (chosen) void compareNamed(chosen.slice(1));
            }}
          >
            <option value="">{t.compareWith}</option>
            {newest && <option value={`=${name}`}>{t.storedText}</option>}
            <option value="file">{t.aFile}</option>
            {programs.value.filter((one) => one.name !== name).map((one) => <option key={one.name} value={`=${one.name}`}>{one.name}</option>)}
          </select>
          <input
            ref={file}
            type="file"
            hidden
            aria-label={t.aFile}
            onChange={(event) => {
              const chosen = event.currentTarget.files?.[0];
              event.currentTarget.value = "";
              void chosen?.arrayBuffer().then((content) => {
                const read = utf8(content);
                if (read === null) tell(t.notText(chosen.name), true);
                else compareWith(chosen.name, read);
              });
            }}
          />
          <button onClick={download}>{t.download}</button>
          <button
            disabled={program.revision === 0 || dirty.value || !channel.value || lacking("operator") !== ""}
            title={t.selectAbout}
            onClick={() => void command(t.select, "select", { program: name })}
          >
            {t.selectKey}
          </button>
          <button disabled={program.revision === 0 || dirty.value || lackingToStore() !== ""} aria-expanded={renaming.value} onClick={() => (renaming.value = !renaming.value)}>{t.rename}</button>
          <button disabled={program.revision === 0 || selected || lackingToStore() !== ""} onClick={() => removeProgram(name, () => { drafts.drop(name); changed(null); })}>{t.deleteKey}</button>
        </div>
        {renaming.value && (
          <Rename
            name={name}
            done={(next) => {
              renaming.value = false;
              void programText(next).then((now) => changed({ name: next, revision: now?.revision ?? 0, stored: program.stored, text: program.stored }));
              void refreshPrograms();
            }}
          />
        )}
        {compared.value && (
          <div class="title comparison" role="status">
            <span class="grow">{t.comparedWith(compared.value.what, compared.value.differences)}</span>
            <button aria-label={t.previousDifference} onClick={() => editor.current?.previous()}>↑</button>
            <button aria-label={t.nextDifference} onClick={() => editor.current?.next()}>↓</button>
            <button
              onClick={() => {
                editor.current?.compare(null);
                compared.value = null;
              }}
            >
              {t.endComparison}
            </button>
          </div>
        )}
        <div class="editor-place" ref={place} />
        <div class="check-line" role="status" data-test="check">
          <CheckLine state={check.value} goTo={(number) => editor.current?.goTo(number)} />
        </div>
      </section>
      <section class="program-side" aria-label={t.outlineAndPath}>
        <div class="title">
          <div class="segments" role="tablist" aria-label={t.outlineAndPath}>
            <button role="tab" aria-selected={side.value === "outline"} onClick={() => (side.value = "outline")}>{t.outline}</button>
            <button role="tab" aria-selected={side.value === "path"} onClick={() => (side.value = "path")}>{t.path}</button>
          </div>
        </div>
        {side.value === "outline" ? (
          <ul class="outline scroll" tabIndex={0} aria-label={t.outline}>
            {entries.value.map((entry) => (
              <li key={`${entry.line}/${entry.kind}`}>
                <button class={`outline-${entry.kind}`} onClick={() => editor.current?.goTo(entry.line)}>
                  <span class="dim digits">{entry.line}</span> <span>{entry.text}</span>
                </button>
              </li>
            ))}
            {entries.value.length === 0 && <li class="dim">{t.noOutline}</li>}
          </ul>
        ) : (
          <PathPreview path={path.value} line={line.value} />
        )}
      </section>
    </>
  );
}
