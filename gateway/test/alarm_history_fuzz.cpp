// SPDX-License-Identifier: Apache-2.0
// Any lines of alarms.jsonl: what is read is written as it is read again.
#include <cstdlib>
#include <string>

#include "core/alarm_history.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using trunnion::gateway::AlarmHistory;
  AlarmHistory history;
  history.restore(std::string(reinterpret_cast<const char*>(data), size));
  const auto lines = history.lines();
  AlarmHistory again;
  if (again.restore(lines) != 0 || again.lines() != lines) std::abort();
  history.apply({}, "2026-01-01T00:00:00Z");
  history.settle("2026-01-01T00:00:01Z");
  for (const auto& past : *history.newest()) trunnion::gateway::past_alarm_document(past);
  return 0;
}
