// SPDX-License-Identifier: Apache-2.0
// What the axes of one channel did in a motion.
#pragma once

#include <array>
#include <vector>

#include "canonical/axes.hpp"
#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

/// Samples of X Y Z A B C U V W at equal intervals; mm or deg, machine coordinates.
struct ChannelMotion {
  double interval = 0.001;                              ///< s
  std::size_t count = 0;                                ///< samples
  std::array<double, canonical::axis_count> resting{};  ///< of axes without a trace
  std::array<AxisTrace, canonical::axis_count> traces;  ///< empty: the axis rests

  double commanded(std::size_t axis, std::size_t i) const { return at(axis, traces[axis].setpoint, i); }
  double feedback(std::size_t axis, std::size_t i) const { return at(axis, traces[axis].feedback, i); }
  /// By the load's encoder where there is one.
  double load(std::size_t axis, std::size_t i) const { return at(axis, traces[axis].load, i); }

 private:
  double at(std::size_t axis, const std::vector<double>& values, std::size_t i) const {
    return values.empty() ? resting[axis] : values[i];
  }
};

}  // namespace trunnion::servo_analysis
