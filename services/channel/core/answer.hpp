// SPDX-License-Identifier: Apache-2.0
// Why a channel refuses a request.
#pragma once

#include <cstdint>
#include <string>

#include "machine/alarm_definition.hpp"

namespace trunnion::channel {

/// One of alarms.yaml, and the reason for the operator.
struct Refusal {
  const machine::AlarmDefinition* alarm;
  std::string reason;
};

/// What the operator is answered.
struct Answer {
  bool accepted = true;
  std::uint32_t alarm = 0;
  std::string reason;
};

}  // namespace trunnion::channel
