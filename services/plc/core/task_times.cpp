// SPDX-License-Identifier: Apache-2.0
#include "task_times.hpp"

#include <algorithm>

namespace trunnion::plc {

void TaskTimes::Use::add(std::uint64_t ns, std::uint64_t executed) {
  ++runs;
  last = ns;
  worst = std::max(worst, ns);
  statements = executed;
  most_statements = std::max(most_statements, executed);
}

void TaskTimes::end_task(TaskName task, std::uint64_t statements) {
  tasks_[static_cast<std::size_t>(task)].add(clock_() - task_begin_, statements);
  scan_statements_ += statements;
}

void TaskTimes::end_scan() { scan_.add(clock_() - scan_begin_, scan_statements_); }

std::vector<plc_online::TaskTime> TaskTimes::shown(const std::array<std::uint64_t, 3>& budgets) const {
  std::vector<plc_online::TaskTime> times;
  const auto show = [&](const char* name, const Use& use, std::uint64_t budget) {
    if (use.runs > 0)
      times.push_back(
          {name, use.runs, use.last, use.worst, scan_period_ns, use.statements, use.most_statements, budget});
  };
  const auto show_task = [&](const char* name, TaskName task) {
    const auto i = static_cast<std::size_t>(task);
    show(name, tasks_[i], budgets[i]);
  };
  show("scan", scan_, 0);
  show_task("simulation", TaskName::simulation);
  show_task("fast", TaskName::fast);
  show_task("main", TaskName::main);
  return times;
}

}  // namespace trunnion::plc
