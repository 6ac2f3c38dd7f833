// SPDX-License-Identifier: Apache-2.0
// What the tasks of a running PLC take, in the answer to a list of variables.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "contracts/types.hpp"

namespace trunnion::plc_online {

/// A LIST_VARIABLES of this prefix is answered with the times of the tasks. No variable's path has a colon.
inline constexpr const char* task_times_prefix = "task:";

/// Times are of the computer's clock: they are never an input of the PLC and differ from run to run.
struct TaskTime {
  std::string name;        ///< scan (all tasks of one scan), simulation, fast, main
  std::uint64_t runs = 0;  ///< in how many scans it ran since the programs began
  std::uint64_t last_ns = 0, worst_ns = 0;
  std::uint64_t budget_ns = 0;                        ///< the tasks of one scan share it
  std::uint64_t statements = 0, most_statements = 0;  ///< of the last scan, and the most of one scan
  std::uint64_t statement_budget = 0;                 ///< of one scan; 0: none
  bool operator==(const TaskTime&) const = default;
};

void add(const TaskTime& time, idl::plc::OnlineReply& reply);
/// What add() has added. Throws std::runtime_error for an answer of another kind: that of an older PLC.
std::vector<TaskTime> task_times(const idl::plc::OnlineReply& reply);
/// {"name", "runs", "last_us", "worst_us", "budget_us", "statements", "most_statements", "statement_budget"}
bus::Json json_of(const std::vector<TaskTime>& times);

}  // namespace trunnion::plc_online
