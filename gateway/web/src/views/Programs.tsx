// SPDX-License-Identifier: Apache-2.0
// The stored programs with the editor beside them.
import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { programText } from "../api";
import { bytes } from "../format";
import { Drafts } from "../program/drafts";
import { folders, isProgramName } from "../program/folders";
import { programs, refreshPrograms } from "../state/programs";
import { machine, tell } from "../state/store";
import { text } from "../text/texts";
import { EditorPane, type OpenProgram } from "./EditorPane";
import { lackingToStore, Note } from "./Guard";
import { Upload } from "./Upload";

/** Larger texts are for a computer with a disk, not for a page. */
const mostEdited = 8_000_000;

function browserStorage(): Storage | undefined {
  try {
    return localStorage;
  } catch {
    return undefined;
  }
}

const drafts = new Drafts(browserStorage());
const unsaved = signal<string[]>(drafts.names());
const opened = signal<OpenProgram | null>(null);

async function open(name: string): Promise<void> {
  if (opened.peek()?.name === name) return;
  const t = text.peek();
  const entry = programs.peek().find((one) => one.name === name);
  if (entry && entry.size > mostEdited) return tell(t.tooLargeToEdit(name, bytes(entry.size)), true);
  const draft = drafts.of(name);
  const stored = entry || !draft ? await programText(name) : null;
  if (!draft && !stored) return tell(t.notRead(name), true);
  if (stored?.text === null) return tell(t.notText(name), true);
  opened.value = {
    name, revision: draft?.revision ?? stored?.revision ?? 0, stored: stored?.text ?? "", text: draft?.text ?? stored?.text ?? "",
  };
}

function NewProgram({ done }: { done: () => void }) {
  const name = useSignal("");
  const t = text.value;
  const wrong = name.value !== "" && !isProgramName(name.value);
  const taken = programs.value.some((one) => one.name === name.value) || unsaved.value.includes(name.value);
  return (
    <form
      class="row"
      aria-label={t.newProgram}
      onSubmit={(event) => {
        event.preventDefault();
        if (!isProgramName(name.value) || taken) return;
        drafts.keep(name.value, { revision: 0, text: "" });
        unsaved.value = drafts.names();
        opened.value = { name: name.value, revision: 0, stored: "", text: "" };
        done();
      }}
    >
      <input
        aria-label={t.newName}
        placeholder={t.newName}
        autofocus
        value={name.value}
        aria-invalid={wrong || taken}
        onInput={(event) => (name.value = event.currentTarget.value)}
      />
      <button type="submit" class="primary">{t.create}</button>
      {wrong && <p class="refusal" role="alert">{t.badName}</p>}
      {taken && <p class="refusal" role="alert">{t.nameTaken(name.value)}</p>}
    </form>
  );
}

function ProgramList() {
  const search = useSignal("");
  const creating = useSignal(false);
  const revision = machine.value.revisions.programs;
  useEffect(() => void refreshPrograms(), [revision]);
  const t = text.value;
  const wanted = (name: string) => name.toLowerCase().includes(search.value.trim().toLowerCase());
  const created = unsaved.value.filter((name) => !programs.value.some((one) => one.name === name));
  const all = [...programs.value, ...created.map((name) => ({ name, size: 0, lines: 0, revision: 0 }))].filter(({ name }) => wanted(name));
  return (
    <section class="program-list" aria-label={t.storedPrograms}>
      <div class="title">
        <input
          type="search"
          placeholder={t.findProgram}
          aria-label={t.findProgram}
          value={search.value}
          onInput={(event) => (search.value = event.currentTarget.value)}
        />
      </div>
      <div class="title">
        <button aria-expanded={creating.value} disabled={lackingToStore() !== ""} onClick={() => (creating.value = !creating.value)}>{t.newProgram}</button>
        <Upload />
      </div>
      <Note why={lackingToStore()} />
      {creating.value && <NewProgram done={() => (creating.value = false)} />}
      <div class="scroll" tabIndex={0} role="region" aria-label={t.storedPrograms}>
        {folders(all).map((folder) => (
          <details open key={folder.name} class={folder.name ? "" : "no-folder"}>
            <summary>{folder.name || t.noFolder}</summary>
            <ul>
              {folder.entries.map((entry) => (
                <li key={entry.name} aria-current={entry.name === opened.value?.name}>
                  <button class="choose" onClick={() => void open(entry.name)}>
                    <b>{entry.name}</b>
                    <span class="dim digits">
                      {entry.revision > 0 ? t.programEntry(bytes(entry.size), entry.lines, entry.revision) : t.newHere}
                    </span>
                    {unsaved.value.includes(entry.name) && <span class="tag warn">{t.notSaved}</span>}
                  </button>
                </li>
              ))}
            </ul>
          </details>
        ))}
        {all.length === 0 && <p class="dim">{t.noProgramFound}</p>}
      </div>
    </section>
  );
}

export function Programs() {
  const one = opened.value;
  return (
    <main class="programs">
      <ProgramList />
      {one ? (
        <EditorPane
          key={one.name}
          program={one}
          drafts={drafts}
          changed={(next) => {
            unsaved.value = drafts.names();
            if (next !== undefined) opened.value = next;
          }}
        />
      ) : (
        <section class="dim" aria-label={text.value.programText}>{text.value.chooseProgram}</section>
      )}
    </main>
  );
}
