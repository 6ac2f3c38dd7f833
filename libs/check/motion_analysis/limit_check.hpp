// SPDX-License-Identifier: Apache-2.0
// What a row of setpoints asks of the axes, by finite differences and nothing else.
#pragma once

#include <array>
#include <cstddef>

#include "canonical/axes.hpp"
#include "motion/limits.hpp"

namespace trunnion::analysis {

using canonical::AxisValues;

/// Largest velocity, acceleration and jerk of one axis as shares of its limits.
struct AxisRatios {
  double velocity = 0, acceleration = 0, jerk = 0;
};

/// Follows machine positions, one per cycle, beginning at rest. It shares no code with the planner.
class LimitCheck {
 public:
  /// `cycle_seconds` above 0.
  LimitCheck(const motion::Limits& limits, const AxisValues& rest, double cycle_seconds);

  /// Position of the next cycle; `rapid` says that the velocity limit is the one of rapid traverse.
  void add(const AxisValues& machine, bool rapid);

  const std::array<AxisRatios, canonical::axis_count>& axes() const { return axes_; }
  /// Worst of all axes.
  AxisRatios worst() const;
  /// Cycles from the first to the last change of any axis; 0 when nothing moved.
  std::size_t moving_cycles() const { return last_ >= first_ ? last_ - first_ + 1 : 0; }

 private:
  motion::Limits limits_;
  double cycle_;
  std::array<AxisValues, 3> before_;  // [0] is the newest
  std::array<AxisRatios, canonical::axis_count> axes_{};
  std::size_t count_ = 0, first_ = 1, last_ = 0;
  bool was_rapid_ = false;
};

}  // namespace trunnion::analysis
