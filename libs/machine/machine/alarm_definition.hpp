// SPDX-License-Identifier: Apache-2.0
// What the constants of alarms (machine/alarm_constants.hpp) are made of.
#pragma once

#include <cstdint>

namespace trunnion::machine {

enum class Severity { hint, warning, error, emergency };
enum class Reaction { show, feed_hold, axis_stop, emergency_stop };
/// What the part of an alarm is the number of.
enum class Subject { machine, channel, axis, service };

/// Only the constants are of this type, so a reference or pointer to one holds for the life of the process.
struct AlarmDefinition {
  constexpr AlarmDefinition(std::uint32_t alarm_number, const char* alarm_name, Severity alarm_severity,
                            Reaction alarm_reaction, Subject alarm_subject, const char* alarm_text)
      : number(alarm_number),
        name(alarm_name),
        severity(alarm_severity),
        reaction(alarm_reaction),
        subject(alarm_subject),
        text(alarm_text) {}
  AlarmDefinition(const AlarmDefinition&) = delete;
  AlarmDefinition& operator=(const AlarmDefinition&) = delete;

  std::uint32_t number;
  const char* name;
  Severity severity;
  Reaction reaction;
  Subject subject;
  const char* text;
};

}  // namespace trunnion::machine
