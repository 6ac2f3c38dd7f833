// SPDX-License-Identifier: Apache-2.0
// What single loops show in a trace: the time constant of the current loop, load encoder against motor
// encoder.
#pragma once

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

/// s, from the steps of the torque's setpoint in `excitation`. Throws std::runtime_error when the torque does
/// not follow them.
double current_time_constant(const AxisTrace& trace);

struct EncoderComparison {
  double ratio = 0;     ///< way of the load encoder over that of the motor encoder, signed
  int motor_sense = 1;  ///< 1: the motor encoder counts upwards while it is compared, else -1
};

/// In the far half of the first motion at constant speed: backlash and friction are behind it. Throws
/// std::runtime_error when there is none.
EncoderComparison compare_encoders(const AxisTrace& trace);

}  // namespace trunnion::servo_analysis
