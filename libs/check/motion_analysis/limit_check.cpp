// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/limit_check.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::analysis {

LimitCheck::LimitCheck(const motion::Limits& limits, const AxisValues& rest, double cycle_seconds)
    : limits_(limits), cycle_(cycle_seconds), before_{rest, rest, rest} {}

void LimitCheck::add(const AxisValues& machine, bool rapid) {
  ++count_;
  const double dt = cycle_;
  for (std::size_t i = 0; i < canonical::axis_count; ++i) {
    const motion::AxisLimits& limit = limits_.axes[i];
    const double q0 = machine[i], q1 = before_[0][i], q2 = before_[1][i], q3 = before_[2][i];
    const double velocity =
        rapid || was_rapid_ ? std::max(limit.velocity, limit.rapid_velocity) : limit.velocity;
    AxisRatios& r = axes_[i];
    r.velocity = std::max(r.velocity, std::abs(q0 - q1) / dt / velocity);
    r.acceleration = std::max(r.acceleration, std::abs(q0 - 2 * q1 + q2) / (dt * dt) / limit.acceleration);
    r.jerk = std::max(r.jerk, std::abs(q0 - 3 * q1 + 3 * q2 - q3) / (dt * dt * dt) / limit.jerk);
    if (q0 != q1) {
      if (last_ < first_) first_ = count_;
      last_ = count_;
    }
  }
  before_ = {machine, before_[0], before_[1]};
  was_rapid_ = rapid;
}

AxisRatios LimitCheck::worst() const {
  AxisRatios worst;
  for (const AxisRatios& r : axes_) {
    worst.velocity = std::max(worst.velocity, r.velocity);
    worst.acceleration = std::max(worst.acceleration, r.acceleration);
    worst.jerk = std::max(worst.jerk, r.jerk);
  }
  return worst;
}

}  // namespace trunnion::analysis
