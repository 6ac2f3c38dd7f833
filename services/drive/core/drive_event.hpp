// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "machine/alarm_definition.hpp"

namespace trunnion::drive {

/// Something to report: the service turns it into an alarm.
struct DriveEvent {
  const machine::AlarmDefinition* alarm = nullptr;
  std::uint32_t part = 0;
  std::string text;
};

}  // namespace trunnion::drive
