// SPDX-License-Identifier: Apache-2.0
// The macro variables of the channel that are not vacant, as its newest program or MDI line has left them.
import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { get } from "../api";
import type { Variables as Table } from "../contract";
import { shownVariables } from "../state/variables";
import { channelNumber } from "../state/store";
import { text } from "../text/texts";

const askedEvery = 1000;  // ms
const filter = signal("");

export function Variables() {
  const number = channelNumber.value;
  const [table, setTable] = useState<Table | null>(null);
  useEffect(() => {
    let wanted = true;
    const ask = async () => {
      const answer = await get<Table>(`/api/variables/${number}`);
      if (wanted) setTable(answer.ok ? (answer.body ?? null) : null);
    };
    void ask();
    const timer = setInterval(() => void ask(), askedEvery);
    return () => {
      wanted = false;
      clearInterval(timer);
    };
  }, [number]);
  const t = text.value;
  const { rows, more } = shownVariables(table, filter.value);
  return (
    <div class="variables">
      <input
        type="search"
        class="digits"
        inputMode="numeric"
        placeholder={t.findVariable}
        aria-label={t.findVariable}
        value={filter.value}
        onInput={(event) => (filter.value = event.currentTarget.value)}
      />
      <div class="list" tabIndex={0} role="region" aria-label={t.variables}>
        <table class="digits">
          <tbody>
            {rows.map(([variable, value]) => (
              <tr key={variable}>
                <th scope="row">#{variable}</th>
                <td data-test={`variable-${variable}`}>{value}</td>
              </tr>
            ))}
          </tbody>
        </table>
        {rows.length === 0 && <p class="dim">{t.noVariables}</p>}
        {more > 0 && <p class="dim">{t.moreVariables(more)}</p>}
      </div>
      <p class="dim">{t.variablesAbout}</p>
    </div>
  );
}
