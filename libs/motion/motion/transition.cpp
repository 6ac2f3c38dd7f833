// SPDX-License-Identifier: Apache-2.0
#include "motion/transition.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {

// With the sign of the change taken out: from the acceleration b up (or down) to a peak p, along it, and back
// to zero changes the speed by p^2 / j - b^2 / (2 j) when nothing is held.
Transition::Transition(double v, double a, double target, const RampLimits& limits) : target_(target) {
  const double j = limits.jerk, most = limits.acceleration;
  const double sign = settled_speed(v, a, j) > target ? -1 : 1;
  const double b = a * sign;
  const double change = (target - v) * sign;
  if (b > most) {
    phases_[0] = {(b - most) / j, -j * sign};
    phases_[1] = {std::max(0.0, (change - b * b / (2 * j)) / most), 0};
    phases_[2] = {most / j, -j * sign};
    return;
  }
  double peak = std::sqrt(std::max(0.0, j * change + b * b / 2));
  double hold = 0;
  if (peak > most) {
    peak = most;
    hold = std::max(0.0, (change - (most * most - b * b / 2) / j) / most);
  }
  peak = std::max({peak, b, 0.0});
  phases_[0] = {(peak - b) / j, j * sign};
  phases_[1] = {hold, 0};
  phases_[2] = {peak / j, -j * sign};
}

PathState Transition::after(const PathState& state, double time) const {
  PathState now = state;
  for (const JerkPhase& phase : phases_) {
    if (time < phase.time) return integrate(now, phase.jerk, time);
    now = integrate(now, phase.jerk, phase.time);
    time -= phase.time;
  }
  return {now.s + target_ * time, target_, 0};
}

double Transition::distance(double v, double a) const {
  PathState state{0, v, a};
  for (const JerkPhase& phase : phases_) state = integrate(state, phase.jerk, phase.time);
  return state.s;
}

double braking_distance(double v, double a, double target, const RampLimits& limits) {
  if (settled_speed(v, a, limits.jerk) > target) return Transition(v, a, target, limits).distance(v, a);
  if (v <= target) return 0;
  // v + a t + j t^2 / 2 = target with a below 0.
  const double root = std::sqrt(std::max(0.0, a * a - 2 * limits.jerk * (v - target)));
  const double time = 2 * (v - target) / (-a + root);
  return integrate({0, v, a}, limits.jerk, time).s;
}

}  // namespace trunnion::motion
