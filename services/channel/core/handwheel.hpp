// SPDX-License-Identifier: Apache-2.0
// Axes that follow the counts of a handwheel, or of several turned at once.
#pragma once

#include <array>
#include <vector>

#include "canonical/axes.hpp"
#include "motion/limits.hpp"

namespace trunnion::channel {

using canonical::AxisValues;

/// One axis that moves to a target that may change in every cycle. Its position is a ramp of limited
/// velocity, averaged over two windows: the first bounds the acceleration, the second the jerk, so every
/// limit is kept whatever the targets do, and the position never leaves the range of the targets given since
/// it was at rest.
class AxisFollower {
 public:
  /// At rest at 0. Limits in mm or degrees and seconds, above 0; where an axis would need more than
  /// `longest_window` cycles to its velocity, it goes slower.
  void configure(double velocity, double acceleration, double jerk, double cycle_seconds);
  /// At rest at `position`.
  void start(double position);
  void set_target(double target) { target_ = target; }
  /// The target becomes what is reached soonest: the follower comes to rest.
  void stop() { target_ = ramp_; }
  double target() const { return target_; }
  double position() const { return position_; }
  bool at_rest() const { return position_ == target_ && settled_ >= windows(); }
  /// The position of the next cycle.
  double step();

  static constexpr std::size_t longest_window = 4096;

 private:
  class Window {
   public:
    void configure(std::size_t cycles) { values_.assign(cycles, 0); }
    void fill(double value);
    double average(double value);
    std::size_t cycles() const { return values_.size(); }

   private:
    std::vector<double> values_{0.0};
    std::size_t next_ = 0;
    double sum_ = 0;
  };
  std::size_t windows() const { return first_.cycles() + second_.cycles(); }

  double step_ = 0;  // of the ramp in one cycle
  double target_ = 0, ramp_ = 0, position_ = 0;
  std::size_t settled_ = 0;  // cycles since the ramp reached its target
  Window first_, second_;
};

/// The followers of a channel's axes.
class Handwheel {
 public:
  /// At rest at 0 everywhere. `velocity` is the fastest of each axis in units/s; `share` (0..1] of every
  /// limit is taken.
  void configure(const motion::Limits& limits, const AxisValues& velocity, double share,
                 double cycle_seconds);
  void start(const AxisValues& position);
  void stop();
  /// Adds `distance` to the target of `axis` within `low` .. `high`; the distance that was added.
  double turn(std::size_t axis, double distance, double low, double high);
  /// The positions of the next cycle.
  const AxisValues& step();
  const AxisValues& position() const { return position_; }
  const AxisValues& target() const { return target_; }
  bool at_rest() const;
  bool zero() const { return at_rest() && position_ == AxisValues{}; }

 private:
  std::array<AxisFollower, canonical::axis_count> followers_;
  AxisValues position_{}, target_{};
};

}  // namespace trunnion::channel
