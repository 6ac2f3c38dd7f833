// SPDX-License-Identifier: Apache-2.0
// Cross reference: the places in the sources that use the watched variables, as the compiler has found them.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get } from "../api";
import type { PlcUse, PlcUses as Page } from "../contract";
import type { Source } from "../plc/source";
import { text } from "../text/texts";

interface Found {
  path: string;
  uses: PlcUse[];
  problem: string;
}

async function usesOf(path: string): Promise<Found> {
  const uses: PlcUse[] = [];
  for (;;) {
    const answer = await get<Page>(`/api/plc/uses?path=${encodeURIComponent(path)}&offset=${uses.length}`);
    if (!answer.ok || !answer.body) return { path, uses, problem: answer.reason };
    uses.push(...answer.body.uses);
    if (answer.body.uses.length === 0 || uses.length >= answer.body.total) return { path, uses, problem: "" };
  }
}

/** `version` changes when other programs run. */
export function PlcUses({ chosen, sources, version }: { chosen: readonly string[]; sources: readonly Source[]; version: string }) {
  const t = text.value;
  const found = useSignal<Found[]>([]);
  const wanted = chosen.join("\n");
  useEffect(() => {
    let ended = false;
    void Promise.all(chosen.map(usesOf)).then((all) => {
      if (!ended) found.value = all;
    });
    return () => {
      ended = true;
    };
  }, [wanted, version]);
  const lines = new Map(sources.map(({ name, text: source }) => [name, source.split("\n")]));
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={t.plcUses}>
      {chosen.length === 0 && <p class="dim">{t.plcNothingWatched}</p>}
      {found.value.map(({ path, uses, problem }) => (
        <table key={path}>
          <caption>{path}</caption>
          <tbody>
            {uses.length === 0 && <tr><td class="dim">{problem || t.plcNotUsed}</td></tr>}
            {uses.map(({ file, line, column, writes, calls, element }) => (
              <tr key={`${file} ${line} ${column}`}>
                <td class="digits">{file}:{line}</td>
                <td>
                  {writes && <span class="tag warn">{t.plcWrites}</span>}
                  {calls && <span class="tag">{t.plcCalls}</span>}
                </td>
                <td><code>{element || (lines.get(file)?.[line - 1] ?? "").trim()}</code></td>
              </tr>
            ))}
          </tbody>
        </table>
      ))}
    </div>
  );
}
