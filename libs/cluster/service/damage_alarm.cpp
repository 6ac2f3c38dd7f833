// SPDX-License-Identifier: Apache-2.0
#include "service/damage_alarm.hpp"

#include <cstdio>

#include "machine/alarm_constants.hpp"

namespace trunnion::service {

void report_damage(AlarmBoard& alarms, std::uint32_t part, const std::string& path, const storage::Kept& kept,
                   const std::string& loss) {
  using storage::KeptState;
  if (kept.state != KeptState::previous && kept.state != KeptState::unusable) return;
  const auto& alarm = kept.state == KeptState::previous ? alarm::state_recovered : alarm::state_lost;
  const auto text = storage::damage_text(path, kept, loss);
  std::fprintf(stderr, "%s\n", text.c_str());
  alarms.raise(alarm, part, text);
  alarms.release(alarm, part);
}

}  // namespace trunnion::service
