// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_modes.hpp"

namespace trunnion::language {

Fault LinuxcncModes::dwell(std::uint16_t at) {
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  words_.use('P');
  const double seconds = words_.value('P');
  if (!(seconds >= 0 && seconds <= longest_dwell)) return {AlarmNumber::value_range, words_.offset('P')};
  output_.push(CommandKind::dwell).dwell_seconds = seconds;
  return {};
}

// A diameter is a matter of the machine: its tables, its display and other programs must know.
Fault LinuxcncModes::set_diameter(std::uint16_t at, bool on) {
  if (on == environment_.diameter_programming()) return {};
  return {AlarmNumber::linuxcnc_function_missing, at,
          on ? "X words are radii here: 040032" : "X words are diameters here: 040032"};
}

Fault LinuxcncModes::set_surface_speed(std::uint16_t at) {
  if (!words_.has('S')) return {AlarmNumber::surface_speed_missing, at};
  double limit = 0;
  if (words_.has('D')) {
    words_.use('D');
    limit = words_.value('D');
    if (!(limit > 0)) return {AlarmNumber::value_range, words_.offset('D')};
  }
  state_.modal.spindle_mode = SpindleMode::surface;
  state_.modal.spindle_limit = limit;
  return {};
}

}  // namespace trunnion::language
