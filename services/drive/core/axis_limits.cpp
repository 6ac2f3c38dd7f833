// SPDX-License-Identifier: Apache-2.0
#include "axis_limits.hpp"

#include <algorithm>

#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

AxisLimits axis_limits(const machine::Parameters& p, std::uint16_t axis) {
  const auto travel = machine::travel_of(p, axis);
  return {std::max(p.get(parameter::rapid_feed, axis), p.get(parameter::maximum_feed, axis)) / 60,
          p.get(parameter::maximum_acceleration, axis),
          travel.positive,
          travel.negative,
          p.get(parameter::following_error_limit, axis),
          p.get(parameter::encoder_difference_limit, axis),
          p.integer(parameter::homing_direction, axis),
          p.integer(parameter::homing_marks, axis),
          p.get(parameter::reference_feed, axis) / 60,
          p.get(parameter::homing_creep_feed, axis) / 60,
          p.get(parameter::reference_coordinate, axis),
          (1 - p.get(parameter::velocity_feedforward, axis)) / p.get(parameter::position_gain, axis)};
}

}  // namespace trunnion::drive
