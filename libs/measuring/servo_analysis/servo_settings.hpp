// SPDX-License-Identifier: Apache-2.0
// The parameters of one axis that tuning sets, in the units of the catalogue.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "machine/parameters.hpp"

namespace trunnion::servo_analysis {

struct ServoSettings {
  double position_gain = 20;                                      ///< 10a900, 1/s
  double speed_gain = 200;                                        ///< 10a901, 1/s
  double speed_integral_time = 20;                                ///< 10a902, ms
  double velocity_feedforward = 1, acceleration_feedforward = 0;  ///< 10a904, 10a905
  double dual_loop_time = 0;                                      ///< 10a934, ms
  double damping_gain = 0;                                        ///< 10a935, 1/s
  double torque_filter_time = 0;                                  ///< 10a936, ms
  double notch_frequency = 0, notch_width = 100;                  ///< 10a937, 10a938, Hz
  double friction_compensation = 0;                               ///< 10a939, share of the rated torque

  static ServoSettings from(const machine::Parameters& parameters, std::uint32_t axis);

  struct Value {
    std::uint32_t number;  ///< of the parameter
    double value;
  };
  std::vector<Value> values(std::uint32_t axis) const;
  bool operator==(const ServoSettings&) const = default;
};

}  // namespace trunnion::servo_analysis
