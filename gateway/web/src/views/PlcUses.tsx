// SPDX-License-Identifier: Apache-2.0
// Cross reference: the lines of the sources that name the watched variables.
import { useMemo } from "preact/hooks";
import type { Paths, Source } from "../plc/source";
import { uses } from "../plc/source";
import { text } from "../text/texts";

export function PlcUses({ chosen, sources, paths }: { chosen: readonly string[]; sources: readonly Source[]; paths: Paths }) {
  const t = text.value;
  const found = useMemo(() => chosen.map((path) => ({ path, lines: uses(path, sources, paths) })), [chosen, sources, paths]);
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={t.plcUses}>
      {found.length === 0 && <p class="dim">{t.plcNothingWatched}</p>}
      {found.map(({ path, lines }) => (
        <table key={path}>
          <caption>{path}</caption>
          <tbody>
            {lines.length === 0 && <tr><td class="dim">{t.plcNotUsed}</td></tr>}
            {lines.map(({ file, line, text: code, writes }) => (
              <tr key={`${file} ${line}`}>
                <td class="digits">{file}:{line}</td>
                <td>{writes && <span class="tag warn">{t.plcWrites}</span>}</td>
                <td><code>{code}</code></td>
              </tr>
            ))}
          </tbody>
        </table>
      ))}
    </div>
  );
}
