// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

/// Setpoint and feedback of one sample; the other columns follow.
inline void add(AxisTrace& t, double setpoint, double feedback, double speed = 0, double torque = 0) {
  t.setpoint.push_back(setpoint), t.feedback.push_back(feedback), t.speed.push_back(speed);
  t.torque.push_back(torque), t.speed_set.push_back(speed), t.excitation.push_back(0);
  t.motor.push_back(feedback), t.load.push_back(feedback);
}

}  // namespace trunnion::servo_analysis
