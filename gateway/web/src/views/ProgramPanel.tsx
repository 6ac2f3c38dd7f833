// SPDX-License-Identifier: Apache-2.0
import { signal, useSignal, useSignalEffect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { programBytes } from "../api";
import { bytes } from "../format";
import { dialectNames } from "../program/dialects";
import { ProgramText } from "../program/lines";
import { reminders } from "../state/functions";
import { failingLine } from "../state/model";
import { plan } from "../state/plan";
import { programs, refreshPrograms, removeProgram } from "../state/programs";
import { channel, command, machine } from "../state/store";
import { text as texts } from "../text/texts";
import { lacking, lackingToStore } from "./Guard";
import { ProgramView } from "./ProgramView";
import { Upload } from "./Upload";

const text = signal<ProgramText | null>(null);
const loaded = signal("");
const loading = signal(false);

/** As it is stored now: the text is that of this revision. */
const newestOf = (name: string) => programs.value.find((entry) => entry.name === name);

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

function Library({ close }: { close: () => void }) {
  const filter = useSignal("");
  const t = texts.value;
  const chosen = channel.value?.program;
  const shown = programs.value.filter((entry) => entry.name.toLowerCase().includes(filter.value.toLowerCase()));
  return (
    <div class="library">
      <input
        type="search"
        placeholder={t.findProgram}
        aria-label={t.findProgram}
        value={filter.value}
        onInput={(event) => (filter.value = event.currentTarget.value)}
      />
      <ul>
        {shown.map((entry) => (
          <li key={entry.name} aria-current={entry.name === chosen}>
            <button
              class="choose"
              disabled={lacking("operator") !== ""}
              onClick={() => {
                void command(t.select, "select", { program: entry.name });
                close();
              }}
            >
              <b>{entry.name}</b>
              <span class="dim digits">
                {t.programEntry(bytes(entry.size), entry.lines, entry.revision)}
              </span>
            </button>
            <button
              aria-label={t.deleteProgram(entry.name)}
              disabled={entry.name === chosen || lackingToStore() !== ""}
              onClick={() => removeProgram(entry.name)}
            >
              ✕
            </button>
          </li>
        ))}
        {shown.length === 0 && <li class="dim">{t.noProgramFound}</li>}
      </ul>
    </div>
  );
}

export function ProgramPanel() {
  const open = useSignal(false);
  const one = channel.value;
  const listRevision = machine.value.revisions.programs;
  useEffect(() => void refreshPrograms(), [listRevision]);
  useSignalEffect(() => {
    const now = channel.value;
    if (now) void load(now.program, newestOf(now.program)?.revision ?? now.program_revision);
  });
  if (!one) return null;
  const t = texts.value;
  const newest = newestOf(one.program);
  const dialect = plan.value?.program === one.program ? dialectNames[plan.value.dialect] : "";
  const older = newest !== undefined && newest.revision !== one.program_revision;
  return (
    <section class="program-panel" aria-label={t.program}>
      <div class="title">
        <h2>{t.program}</h2>
        <b class="name">{one.program || t.noneSelected}</b>
        {dialect && <span class="dim" data-test="dialect">{dialect}</span>}
        <div class="end">
          <button aria-expanded={open.value} onClick={() => (open.value = !open.value)}>
            {open.value ? t.backToText : t.selectProgram}
          </button>
          <Upload />
        </div>
      </div>
      {(one.detail || reminders(one, t).length > 0) && (
        <div class="program-detail" data-test="detail">
          {reminders(one, t).map((what) => (
            <span class="tag warn" key={what}>
              {what}
            </span>
          ))}
          <span>{one.detail}</span>
        </div>
      )}
      {older && (
        <div class="program-detail" data-test="other-revision">
          <span class="tag warn">{t.revisionShown(newest.revision)}</span>
          <span>{t.revisionSelected(one.program_revision)}</span>
        </div>
      )}
      {open.value ? (
        <Library close={() => (open.value = false)} />
      ) : text.value ? (
        <ProgramView text={text.value} line={one.line} failing={failingLine(machine.value, one)} />
      ) : (
        <div class="code dim">{loading.value ? t.loading : one.program ? "" : t.selectOrMdi}</div>
      )}
    </section>
  );
}
