// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/loop_figures.hpp"

#include <cmath>
#include <stdexcept>

#include "servo_analysis/motion_figures.hpp"

namespace trunnion::servo_analysis {

// In the period of a step the other loops do nothing yet: the torque changes by a share of the step, which is
// the period over the time constant.
double current_time_constant(const AxisTrace& t) {
  double both = 0, square = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double step = t.excitation[i] - t.excitation[i - 1];
    both += step * (t.torque[i] - t.torque[i - 1]);
    square += step * step;
  }
  if (!(both > 0)) throw std::runtime_error("the torque does not follow its setpoint");
  return t.interval / (both / square);
}

EncoderComparison compare_encoders(const AxisTrace& t) {
  constexpr double least_phase = 0.2;  // s
  const auto phases = constant_phases(t, least_phase);
  if (phases.empty()) throw std::runtime_error("the motion had no constant speed");
  const auto end = phases.front().end, half = (phases.front().begin + end) / 2;
  double motor_mean = 0, load_mean = 0, both = 0, square = 0;
  for (std::size_t i = half; i < end; ++i) motor_mean += t.motor[i], load_mean += t.load[i];
  motor_mean /= static_cast<double>(end - half), load_mean /= static_cast<double>(end - half);
  for (std::size_t i = half; i < end; ++i) {
    both += (t.motor[i] - motor_mean) * (t.load[i] - load_mean);
    square += std::pow(t.motor[i] - motor_mean, 2);
  }
  return {square > 0 ? both / square : 0, std::signbit(t.motor[end - 1] - t.motor[half]) ? -1 : 1};
}

}  // namespace trunnion::servo_analysis
