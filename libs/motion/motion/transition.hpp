// SPDX-License-Identifier: Apache-2.0
// The fastest change from one speed to another under limits of acceleration and jerk, in closed form.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace trunnion::motion {

/// Where the path coordinate is and how it moves: mm (or degrees), per second, per second squared.
struct PathState {
  double s = 0, v = 0, a = 0;
};

/// What a change of speed may use, both above 0.
struct RampLimits {
  double acceleration = 1, jerk = 1;
};

struct JerkPhase {
  double time = 0, jerk = 0;
};

/// `state` after `time` seconds of constant jerk.
inline PathState integrate(const PathState& state, double jerk, double time) {
  return {state.s + time * (state.v + time * (state.a / 2 + time * jerk / 6)),
          state.v + time * (state.a + time * jerk / 2), state.a + time * jerk};
}

/// Three phases of constant jerk that end at a speed with no acceleration left, in the least time. A present
/// acceleration beyond the limit is brought back to it first.
class Transition {
 public:
  Transition(double v, double a, double target, const RampLimits& limits);

  double duration() const { return phases_[0].time + phases_[1].time + phases_[2].time; }

  /// `state` after `time` of the transition, which must have been made for its speed and acceleration. Behind
  /// the end: the target speed without acceleration.
  PathState after(const PathState& state, double time) const;

  /// Path travelled until the target is reached.
  double distance(double v, double a) const;

  const std::array<JerkPhase, 3>& phases() const { return phases_; }

 private:
  std::array<JerkPhase, 3> phases_;
  double target_;
};

/// Path needed until the speed has fallen to `target` for good: the whole transition, or, when braking goes
/// below the target anyway, the part until it is passed while the acceleration is reduced.
double braking_distance(double v, double a, double target, const RampLimits& limits);

/// Speed reached when the acceleration is reduced to zero at once.
inline double settled_speed(double v, double a, double jerk) { return v + a * std::abs(a) / (2 * jerk); }

}  // namespace trunnion::motion
