// SPDX-License-Identifier: Apache-2.0
#include "spindle_gear.hpp"

#include <limits>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

GearSpeeds gear_speeds(const machine::Parameters& parameters, std::uint16_t spindle) {
  GearSpeeds speeds{};
  for (std::uint32_t gear = 0; gear < gear_count; ++gear)
    speeds[gear] = parameters.get(parameter::gear_highest_speed, spindle, gear);
  return speeds;
}

double SpindleGear::highest() const {
  const std::uint8_t gear = in_force();
  return gear == 0 ? std::numeric_limits<double>::infinity() : highest_[gear - 1u];
}

}  // namespace trunnion::drive
