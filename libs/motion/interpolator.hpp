// The interpolation stage: a moving average that turns the velocity steps of the path into bounded
// acceleration.
#pragma once

#include <array>

#include "motion/limits.hpp"

namespace trunnion::motion {

/// Mean of the last N positions of every axis. With x the positions that go in, dt the cycle and T = N dt,
/// what comes out has velocity (x[k] - x[k-N]) / T, acceleration (x'[k] - x'[k-N]) / T and jerk (x''[k] -
/// x''[k-N]) / T, so an acceleration bounded by a gives a jerk of at most 2 a / T. The sum is taken anew each
/// cycle in a fixed order, relative to the newest position: nothing drifts, and at rest the newest position
/// comes out bit for bit.
class Interpolator {
 public:
  /// `cycles` is clamped to 1..max_smoothing_cycles.
  explicit Interpolator(int cycles);

  /// Stand still at `position`.
  void reset(const AxisValues& position);

  /// Takes the position of the next cycle and returns the smoothed one.
  AxisValues step(const AxisValues& position);

  int cycles() const { return cycles_; }

 private:
  int cycles_;
  int next_ = 0;
  std::array<AxisValues, max_smoothing_cycles> ring_{};
};

}  // namespace trunnion::motion
