// SPDX-License-Identifier: Apache-2.0
import { signal, useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { get, programBytes, type ProgramEntry, remove, upload } from "../api";
import { bytes } from "../format";
import { ProgramText } from "../program/lines";
import { reminders } from "../state/functions";
import { failingLine } from "../state/model";
import { channel, command, commandTo, machine, tell } from "../state/store";
import { ProgramView } from "./ProgramView";

const programs = signal<ProgramEntry[]>([]);
const text = signal<ProgramText | null>(null);
const loaded = signal("");
const loading = signal(false);

async function refreshList(): Promise<void> {
  const answer = await get<{ programs: ProgramEntry[] }>("/api/programs");
  if (answer.ok && answer.body) programs.value = answer.body.programs;
}

/** Fetches the text once per program and revision. */
async function load(name: string, revision: number): Promise<void> {
  const key = `${name}/${revision}`;
  if (loaded.peek() === key) return;
  loaded.value = key;
  text.value = null;
  if (!name) return;
  loading.value = true;
  const content = await programBytes(name);
  if (loaded.peek() !== key) return;
  loading.value = false;
  if (content) text.value = new ProgramText(content);
  else loaded.value = "";
}

async function uploadFile(file: File): Promise<void> {
  await refreshList();
  const same = programs.peek().find((entry) => entry.name === file.name);
  if (same && !window.confirm(`${file.name} is stored already (revision ${same.revision}). Store this file in its place?`))
    return;
  tell(`Uploading ${file.name} (${bytes(file.size)})…`, false);
  const answer = await upload(file.name, file);
  tell(answer.ok ? `${file.name} is stored` : `Upload of ${file.name}: ${answer.reason}`, !answer.ok);
  await refreshList();
}

function Library({ close }: { close: () => void }) {
  const filter = useSignal("");
  const chosen = channel.value?.program;
  const shown = programs.value.filter((entry) => entry.name.toLowerCase().includes(filter.value.toLowerCase()));
  return (
    <div class="library">
      <input
        type="search"
        placeholder="Find a program"
        aria-label="find a program"
        value={filter.value}
        onInput={(event) => (filter.value = event.currentTarget.value)}
      />
      <ul>
        {shown.map((entry) => (
          <li key={entry.name} aria-current={entry.name === chosen}>
            <button
              class="choose"
              onClick={() => {
                void command("Select", "select", { program: entry.name });
                close();
              }}
            >
              <b>{entry.name}</b>
              <span class="dim digits">
                {bytes(entry.size)} · {entry.lines} lines · revision {entry.revision}
              </span>
            </button>
            <button
              aria-label={`delete ${entry.name}`}
              disabled={entry.name === chosen}
              onClick={() => {
                if (!window.confirm(`Delete ${entry.name}?`)) return;
                void remove(`/api/programs/${encodeURIComponent(entry.name)}`).then((answer) => {
                  if (!answer.ok) tell(`Delete: ${answer.reason}`, true);
                  return refreshList();
                });
              }}
            >
              ✕
            </button>
          </li>
        ))}
        {shown.length === 0 && <li class="dim">No program.</li>}
      </ul>
    </div>
  );
}

const mdiHistory = signal<string[]>([]);

function Mdi() {
  const line = useSignal("");
  const at = useSignal(-1);
  const one = channel.value;
  const execute = async () => {
    const entered = line.value.trim();
    if (!entered || !one) return;
    if (one.mode !== "MDI" && !(await command("Mode", "mode", { mode: "MDI" }))) return;
    mdiHistory.value = [entered, ...mdiHistory.value.filter((old) => old !== entered)].slice(0, 50);
    at.value = -1;
    if (await commandTo(one.channel, "MDI", "mdi", { line: entered })) line.value = "";
  };
  const recall = (step: number) => {
    const next = Math.min(mdiHistory.value.length - 1, Math.max(-1, at.value + step));
    at.value = next;
    line.value = next < 0 ? "" : (mdiHistory.value[next] ?? "");
  };
  return (
    <form
      class="mdi"
      onSubmit={(event) => {
        event.preventDefault();
        void execute();
      }}
    >
      <label for="mdi">MDI</label>
      <input
        id="mdi"
        data-test="mdi"
        value={line.value}
        maxLength={255}
        spellcheck={false}
        autocomplete="off"
        placeholder="G0 X10 Y20    (↑ ↓ earlier lines)"
        onInput={(event) => (line.value = event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === "ArrowUp") recall(1);
          else if (event.key === "ArrowDown") recall(-1);
          else return;
          event.preventDefault();
        }}
      />
      <button type="submit" data-test="mdi-send">Execute</button>
    </form>
  );
}

export function ProgramPanel() {
  const open = useSignal(false);
  const file = useRef<HTMLInputElement>(null);
  const one = channel.value;
  const listRevision = machine.value.revisions.programs;
  useEffect(() => void refreshList(), [listRevision]);
  useSignalEffect(() => {
    const now = channel.value;
    if (now) void load(now.program, now.program_revision);
  });
  if (!one) return null;
  const newest = programs.value.find((entry) => entry.name === one.program);
  const older = newest !== undefined && newest.revision !== one.program_revision;
  return (
    <section class="program-panel" aria-label="program">
      <div class="title">
        <h2>Program</h2>
        <b class="name">{one.program || "none selected"}</b>
        <div class="end">
          <button aria-expanded={open.value} onClick={() => (open.value = !open.value)}>
            {open.value ? "Back to text" : "Select…"}
          </button>
          <button onClick={() => file.current?.click()}>Upload…</button>
          <input
            ref={file}
            type="file"
            hidden
            onChange={(event) => {
              const chosen = event.currentTarget.files?.[0];
              if (chosen) void uploadFile(chosen);
              event.currentTarget.value = "";
            }}
          />
        </div>
      </div>
      {(one.detail || reminders(one).length > 0) && (
        <div class="program-detail" data-test="detail">
          {reminders(one).map((what) => (
            <span class="tag warn" key={what}>
              {what}
            </span>
          ))}
          <span>{one.detail}</span>
        </div>
      )}
      {older && (
        <div class="program-detail" data-test="other-revision">
          <span class="tag warn">revision {newest.revision} is shown</span>
          <span>Revision {one.program_revision} is selected; select the program again to use the new text.</span>
        </div>
      )}
      {open.value ? (
        <Library close={() => (open.value = false)} />
      ) : text.value ? (
        <ProgramView text={text.value} line={one.line} failing={failingLine(machine.value, one)} />
      ) : (
        <div class="code dim">{loading.value ? "Loading…" : one.program ? "" : "Select a program or enter an MDI line."}</div>
      )}
      <Mdi />
    </section>
  );
}
