// SPDX-License-Identifier: Apache-2.0
// Figures of an axis that moves to and fro: following error, speed ripple, overshoot, peaks of acceleration.
#pragma once

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

/// Samples begin .. end - 1, in which the setpoint has one speed other than zero.
struct ConstantPhase {
  std::size_t begin = 0, end = 0;
  double speed = 0;  ///< signed, mm/s or deg/s
};

/// Phases of at least `shortest` s, in their order. A setpoint has one speed where its change from sample to
/// sample differs by less than 0.5 % of it.
std::vector<ConstantPhase> constant_phases(const AxisTrace& trace, double shortest);

struct MotionFigures {
  std::size_t phases = 0;      ///< at constant speed; without one the other figures are zero
  double speed = 0;            ///< fastest of them, mm/s or deg/s
  double following_error = 0;  ///< mean at constant speed, in the direction of motion, mm or deg
  double following_peak = 0;   ///< largest of the whole trace
  double velocity_gain = 0;    ///< speed over following error, 1/s; 0 where the error is below 1e-9
  /// Largest deviation of the speed from the commanded one at constant speed, less the mean deviation.
  double ripple = 0;
  double overshoot = 0;          ///< largest excess of the speed over the commanded one at constant speed
  double acceleration_peak = 0;  ///< largest in the positive direction, of the motor's speed over 2 ms
  double deceleration_peak = 0;  ///< in the negative one, positive number
};

/// `settling` s at the beginning of each phase belong to the overshoot and not to ripple and following error.
MotionFigures motion_figures(const AxisTrace& trace, double settling = 0.1);

/// Time after which the following error of a position loop of `position_gain` 1/s without feed-forward is
/// within 0.25 % of its final value, s; at least 0.1.
double settling_time(double position_gain);

/// Share of `speed` (mm/s or deg/s), at most 1, at which the following error of a position loop without
/// feed-forward, speed over gain, is at most half of `limit` (mm or deg; 0: none).
double bearable_share(double speed, double position_gain, double limit);

/// Largest jump of the following error within `window` s after the setpoint has turned, mm or deg: largest
/// less least value of feedback - setpoint in the window, less what it was in the window before. The feedback
/// is that of the position loop.
double reversal_jump(const AxisTrace& trace, double window = 0.1);

}  // namespace trunnion::servo_analysis
