// SPDX-License-Identifier: Apache-2.0
// What the executor takes from the parameters of an axis.
#pragma once

#include <cstdint>

#include "machine/parameters.hpp"

namespace trunnion::drive {

/// mm or deg, mm/s or deg/s, mm/s2 or deg/s2.
struct AxisLimits {
  double velocity, acceleration, positive, negative, following, encoder_difference;
  int homing_direction;  ///< 0: none is needed
  int homing_marks;      ///< 10a922
  double homing_search, homing_creep, reference;
  double lag = 0;  ///< s: following error per speed (10a900, 10a904)
};

AxisLimits axis_limits(const machine::Parameters& parameters, std::uint16_t axis);

}  // namespace trunnion::drive
