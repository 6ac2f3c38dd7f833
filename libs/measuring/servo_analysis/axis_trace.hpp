// SPDX-License-Identifier: Apache-2.0
// What the control loops of one axis did during a test.
#pragma once

#include <cstddef>
#include <vector>

namespace trunnion::servo_analysis {

/// Samples at equal intervals, all of the same number. mm or deg, per second; torques are shares of the rated
/// torque. Columns as in idl/servo.idl.
struct AxisTrace {
  double interval = 0.001;  ///< s
  std::vector<double> setpoint, feedback;
  std::vector<double> speed_set;  ///< setpoint of the speed loop, the excitation included
  std::vector<double> speed, torque, excitation;
  std::vector<double> motor, load;  ///< encoders; the same where there is one

  std::size_t size() const { return setpoint.size(); }
};

/// mm/min or deg/min per mm/s or deg/s.
inline constexpr double per_minute = 60;

}  // namespace trunnion::servo_analysis
