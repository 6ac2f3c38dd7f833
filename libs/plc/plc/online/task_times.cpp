// SPDX-License-Identifier: Apache-2.0
#include "plc/online/task_times.hpp"

#include <array>
#include <stdexcept>

namespace trunnion::plc_online {
namespace {

constexpr std::uint64_t TaskTime::*members[] = {
    &TaskTime::runs,       &TaskTime::last_ns,         &TaskTime::worst_ns,        &TaskTime::budget_ns,
    &TaskTime::statements, &TaskTime::most_statements, &TaskTime::statement_budget};

double microseconds(std::uint64_t ns) { return static_cast<double>(ns) / 1000; }

}  // namespace

void add(const TaskTime& time, idl::plc::OnlineReply& reply) {
  idl::plc::VariableInfo info;
  info.path = task_times_prefix + time.name;
  info.type = "ULINT";
  info.kind = idl::plc::ValueKind::UNSIGNED_VALUE;
  info.cells = static_cast<std::uint16_t>(std::size(members));
  reply.variables.push_back(std::move(info));
  reply.total = static_cast<std::uint32_t>(reply.variables.size());
  for (const auto member : members) reply.cells.push_back(time.*member);
}

std::vector<TaskTime> task_times(const idl::plc::OnlineReply& reply) {
  std::vector<TaskTime> times;
  constexpr std::string_view prefix = task_times_prefix;
  if (reply.variables.empty() || reply.cells.size() != reply.variables.size() * std::size(members))
    throw std::runtime_error("this PLC is of a version that does not measure its tasks");
  for (std::size_t i = 0; i < reply.variables.size(); ++i) {
    TaskTime time;
    const std::string& path = reply.variables[i].path;
    time.name = path.substr(std::min(prefix.size(), path.size()));
    for (std::size_t m = 0; m < std::size(members); ++m)
      time.*members[m] = reply.cells[i * std::size(members) + m];
    times.push_back(std::move(time));
  }
  return times;
}

bus::Json json_of(const std::vector<TaskTime>& times) {
  auto list = bus::Json::array();
  for (const auto& time : times)
    list.push_back({{"name", time.name},
                    {"runs", time.runs},
                    {"last_us", microseconds(time.last_ns)},
                    {"worst_us", microseconds(time.worst_ns)},
                    {"budget_us", microseconds(time.budget_ns)},
                    {"statements", time.statements},
                    {"most_statements", time.most_statements},
                    {"statement_budget", time.statement_budget}});
  return list;
}

}  // namespace trunnion::plc_online
