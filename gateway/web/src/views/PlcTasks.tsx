// SPDX-License-Identifier: Apache-2.0
// How long the tasks of the PLC take.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get } from "../api";
import type { PlcTasks as Tasks } from "../contract";
import { fixed } from "../format";
import { text } from "../text/texts";

const period = 1000;  // ms

export function PlcTasks() {
  const t = text.value;
  const shown = useSignal<Tasks["tasks"]>([]);
  const problem = useSignal("");
  useEffect(() => {
    let ended = false;
    const look = async () => {
      const answer = await get<Tasks>("/api/plc/tasks");
      if (ended) return;
      problem.value = answer.reason;
      if (answer.body?.tasks) shown.value = answer.body.tasks;
    };
    void look();
    const timer = setInterval(() => void look(), period);
    return () => {
      ended = true;
      clearInterval(timer);
    };
  }, []);
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={t.plcTasks}>
      {problem.value && <p class="refusal" role="status">{problem.value}</p>}
      <table data-test="plc-tasks">
        <thead>
          <tr><th>{t.plcTask}</th><th class="right">{t.plcLast}</th><th class="right">{t.plcWorst}</th><th class="right">{t.plcBudget}</th><th class="right">{t.plcStatements}</th></tr>
        </thead>
        <tbody>
          {shown.value.map((task) => (
            <tr key={task.name} class={task.worst_us > task.budget_us ? "forced" : ""}>
              <td>{task.name === "scan" ? t.plcWholeScan : task.name}</td>
              <td class="right digits">{fixed(task.last_us, 1)}</td>
              <td class="right digits">{fixed(task.worst_us, 1)}</td>
              <td class="right digits">{task.budget_us}</td>
              <td class="right digits" title={t.plcMostStatements(task.most_statements)}>{task.statements}{task.statement_budget > 0 ? ` / ${task.statement_budget}` : ""}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="dim">{t.plcTasksAbout}</p>
    </div>
  );
}
