// The alarm list that is compiled in from libs/machine/alarms.yaml.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::machine {

enum class Severity { hint, warning, error, emergency };
enum class Reaction { show, feed_hold, axis_stop, emergency_stop };

struct AlarmDefinition {
  std::uint32_t number = 0;
  std::string name;
  Severity severity = Severity::error;
  Reaction reaction = Reaction::show;
  std::string text;
};

const std::vector<AlarmDefinition>& alarm_list();
/// Throws std::out_of_range: code only raises alarms that are listed.
const AlarmDefinition& alarm_definition(const std::string& name);

}  // namespace trunnion::machine
