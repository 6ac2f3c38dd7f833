// SPDX-License-Identifier: Apache-2.0
// The stored programs: their list, and what is done with them.
import { signal } from "@preact/signals";
import { get, type ProgramEntry, remove, upload } from "../api";
import { bytes, refusal } from "../format";
import { text } from "../text/texts";
import { ask } from "../views/Question";
import { tell } from "./store";

export const programs = signal<ProgramEntry[]>([]);

export async function refreshPrograms(): Promise<void> {
  const answer = await get<{ programs: ProgramEntry[] }>("/api/programs");
  if (answer.ok && answer.body) programs.value = answer.body.programs;
}

async function store(file: File): Promise<void> {
  const t = text.peek();
  tell(t.uploading(file.name, bytes(file.size)), false);
  const answer = await upload(file.name, file);
  tell(answer.ok ? t.stored(file.name) : refusal(t.uploadOf(file.name), answer.reason), !answer.ok);
  await refreshPrograms();
}

/** Asks before a program of the same name is replaced. */
export async function uploadFile(file: File): Promise<void> {
  await refreshPrograms();
  const same = programs.peek().find((entry) => entry.name === file.name);
  const t = text.peek();
  if (same) ask(t.replaceQuestion(file.name, same.revision), t.replaceKey, () => void store(file));
  else await store(file);
}

/** Asks first. */
export function removeProgram(name: string, removed: () => void = () => undefined): void {
  const t = text.peek();
  ask(t.deleteQuestion(name), t.deleteKey, () => {
    void remove(`/api/programs/${encodeURIComponent(name)}`).then(async (answer) => {
      if (answer.ok) removed();
      else tell(refusal(t.deleteProgram(name), answer.reason), true);
      await refreshPrograms();
    });
  });
}
