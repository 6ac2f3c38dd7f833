// SPDX-License-Identifier: Apache-2.0
// The recordings that the machine keeps: start, stop, open, download, delete.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Source } from "../analysis/recording";
import { get, post, remove } from "../api";
import type { RecordingEntry, RecordingList } from "../contract";
import { fixed } from "../format";
import { tell } from "../state/store";
import { text } from "../text/texts";
import { lackingToStore } from "./Guard";
import { ask } from "./Question";

const list = signal<RecordingList | null>(null);
const path = (name: string) => `/api/recordings/${encodeURIComponent(name)}`;

async function refresh(): Promise<void> {
  const answer = await get<RecordingList>("/api/recordings");
  if (answer.ok && answer.body) list.value = answer.body;
  else tell(answer.reason, true);
}

async function order(done: Promise<{ ok: boolean; reason: string }>): Promise<void> {
  const answer = await done;
  if (!answer.ok) tell(answer.reason, true);
  await refresh();
}

/** `opened` shows a recording, `compared` its difference from the one that is shown; null when none is. */
export function Recordings({ opened, compared }: { opened: (source: Source) => void; compared: ((source: Source) => void) | null }) {
  const t = text.value;
  const known = list.value;
  useEffect(() => {
    void refresh();
    const timer = setInterval(() => void (list.peek()?.recording && refresh()), 2000);
    return () => clearInterval(timer);
  }, []);
  const source = ({ name }: RecordingEntry): Source => ({ name, url: `${path(name)}/table` });
  return (
    <section class="recordings" aria-label={t.recordingsOf}>
      <div class="recordings-keys">
        {known?.recording ? (
          <>
            <button onClick={() => void order(post(`${path(known.recording)}/stop`))}>{t.stopRecording}</button>
            <b role="status">{t.recordingNow(known.recording)}</b>
          </>
        ) : (
          <button onClick={() => void order(post("/api/recordings"))}>{t.startRecording}</button>
        )}
        {known && <span class="dim">{t.freeSpace(fixed(known.free / 1e9, 1))}</span>}
      </div>
      {known?.problem && <p role="alert">{known.problem}</p>}
      {known?.recordings.length === 0 && <p class="dim">{t.noRecordings}</p>}
      <p class="dim">{t.recordingsAbout}</p>
      {known && known.recordings.length > 0 && (
        <table>
          <thead>
            <tr>
              <th>{t.recordingName}</th>
              <th>{t.recordingSize}</th>
              <th>{t.recordingTime}</th>
              <th aria-label={t.recordings} />
            </tr>
          </thead>
          <tbody>
            {known.recordings.map((one) => (
              <tr key={one.name}>
                <th scope="row">{one.name}</th>
                <td class="digits">{fixed(one.size / 1e6, 1)}</td>
                <td class="digits">{new Date(one.modified).toLocaleString()}</td>
                <td class="recordings-keys">
                  <button aria-label={`${t.openShort} ${one.name}`} onClick={() => opened(source(one))}>{t.openShort}</button>
                  {compared && <button aria-label={`${t.compareShort} ${one.name}`} onClick={() => compared(source(one))}>{t.compareShort}</button>}
                  <a class="key" href={path(one.name)} download={one.name} aria-label={`${t.download} ${one.name}`}>{t.download}</a>
                  <button
                    disabled={one.recording || lackingToStore() !== ""}
                    title={lackingToStore() || undefined}
                    aria-label={`${t.deleteRecording} ${one.name}`}
                    onClick={() => ask(t.deleteRecordingQuestion(one.name), t.deleteRecording, () => void order(remove(path(one.name), { "If-Match": one.etag })))}
                  >
                    {t.deleteRecording}
                  </button>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}
