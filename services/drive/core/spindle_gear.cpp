// SPDX-License-Identifier: Apache-2.0
#include "spindle_gear.hpp"

#include <algorithm>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

GearSpeeds gear_speeds(const machine::Parameters& parameters, std::uint16_t spindle) {
  GearSpeeds speeds{};
  for (std::uint32_t gear = 0; gear < gear_count; ++gear)
    speeds[gear] = parameters.get(parameter::gear_highest_speed, spindle, gear);
  return speeds;
}

double SpindleGear::limited(double speed) const {
  const std::uint8_t gear = in_force();
  if (gear == 0) return speed;
  const double highest = highest_[gear - 1u];
  return std::clamp(speed, -highest, highest);
}

}  // namespace trunnion::drive
