// SPDX-License-Identifier: Apache-2.0
// How long the tasks of a PLC take, and how many statements they execute.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plc/online/task_times.hpp"
#include "structured_text.hpp"

namespace trunnion::plc {

inline constexpr std::uint64_t scan_period_ns = 1000000;  ///< which the tasks of one scan share

/// Nothing of this is part of the PLC's state: no program, recording or comparison sees it.
class TaskTimes {
 public:
  /// ns of a clock that never goes back.
  using Clock = std::uint64_t (*)();
  explicit TaskTimes(Clock clock) : clock_(clock) {}

  // Of a scan: begins, then each task with its end, then ends. No allocation.
  void begin_scan() { scan_begin_ = task_begin_ = clock_(), scan_statements_ = 0; }
  void begin_task() { task_begin_ = clock_(); }
  void end_task(TaskName task, std::uint64_t statements);
  void end_scan();
  /// Other programs begin.
  void reset() { scan_ = {}, tasks_ = {}; }

  /// The scan, then each task that has run, in the order in which they run. `budgets`: the most statements of
  /// each in one scan, by TaskName; 0: no limit.
  std::vector<plc_online::TaskTime> shown(const std::array<std::uint64_t, 3>& budgets) const;

 private:
  struct Use {
    std::uint64_t runs = 0, last = 0, worst = 0, statements = 0, most_statements = 0;
    void add(std::uint64_t ns, std::uint64_t executed);
  };
  Clock clock_;
  std::uint64_t scan_begin_ = 0, task_begin_ = 0, scan_statements_ = 0;
  Use scan_;
  std::array<Use, 3> tasks_;  ///< by TaskName
};

}  // namespace trunnion::plc
