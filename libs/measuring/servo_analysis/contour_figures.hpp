// SPDX-License-Identifier: Apache-2.0
// Figures of axes that move together: roundness with quadrant jumps, servo mismatch, RTCP simultaneous
// motion.
#pragma once

#include <array>

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

/// Time by which the feedback of an axis is behind its setpoint: the least-squares solution of error = lag *
/// speed over the trace, s. 0 for an axis that does not move.
double time_lag(const AxisTrace& trace);

struct CirclePoint {
  double angle = 0;      ///< deg of the setpoint about the centre, 0 .. 360
  double deviation = 0;  ///< of the radius, mm
};

struct RoundnessFigures {
  double radius = 0;        ///< of the setpoints, mm
  double deviation = 0;     ///< largest less least radius, mm (circular deviation G of ISO 230-4)
  double radius_error = 0;  ///< mean radius less that of the setpoints
  /// Time lag of the first axis less that of the second, ms; from the second harmonic of the deviation.
  double mismatch = 0;
  std::array<double, 4> quadrant_jump{};  ///< at 0, 90, 180 and 270 deg, mm, above zero
  std::vector<CirclePoint> points;        ///< of one turn
};

/// The last whole turn of two axes on a circle at constant speed, by the feedback of the position loops.
/// Throws std::runtime_error when the traces have no whole turn.
RoundnessFigures roundness(const AxisTrace& first, const AxisTrace& second);

struct SimultaneousFigures {
  double linear = 0;  ///< mm: largest difference of the lags of two linear axes times the speed of the tip
  double rotary =
      0;  ///< mm: lag of the rotary axis less the mean of the linear axes' times the speed of the tip
  std::vector<double> lags;  ///< s, of the linear axes, then of the rotary axis
};

/// RTCP simultaneous motion: a rotary axis turns, linear axes keep the tool tip at its place of the
/// workpiece. Linear axes that hardly move (below 5 % of the fastest) do not count.
SimultaneousFigures simultaneous_motion(const std::vector<AxisTrace>& linear, const AxisTrace& rotary);

}  // namespace trunnion::servo_analysis
