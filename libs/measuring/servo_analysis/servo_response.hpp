// SPDX-License-Identifier: Apache-2.0
// The servo of one axis as a transfer function: identified from samples of its loops, and what it makes of a
// commanded motion.
#pragma once

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

/// Hv(s) = wn^2 (tau s + 1) / (s^2 + 2 xi wn s + wn^2), speed over setpoint of the speed loop, with one zero
/// and two poles; around it a position loop: setpoint of the speed = Kv (setpoint - position) + kv
/// d(setpoint)/dt.
struct ServoResponse {
  double natural_frequency = 100;  ///< wn, rad/s
  double damping = 1;              ///< xi
  double zero_time = 0;            ///< tau, s
  double position_gain = 60;       ///< Kv, 1/s
  double feedforward = 0;          ///< kv, share of the commanded velocity
  /// Per cent of the speed's variation that the model explains: 100 (1 - |measured - model| / |measured -
  /// mean|), as usual in system identification (Ljung, 1999, 16.4).
  double fit = 0;
};

/// Least squares of the simulated speed (output error, Levenberg-Marquardt) over the whole trace, then of the
/// setpoint of the speed. The trace must begin at rest or at constant speed. Throws std::runtime_error when
/// the axis does not move or the trace is shorter than 16 samples.
ServoResponse fit_servo_response(const AxisTrace& trace);

/// Positions that the model reaches for setpoints at equal intervals (s), at rest before the first one.
std::vector<double> predicted_positions(const ServoResponse& response, const std::vector<double>& setpoints,
                                        double interval);

/// Speeds of Hv alone for setpoints of the speed.
std::vector<double> predicted_speeds(const ServoResponse& response, const std::vector<double>& setpoints,
                                     double interval);

}  // namespace trunnion::servo_analysis
