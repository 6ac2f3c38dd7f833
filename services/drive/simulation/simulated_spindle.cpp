// SPDX-License-Identifier: Apache-2.0
#include "simulated_spindle.hpp"

#include <algorithm>

namespace trunnion::drive {
namespace {
constexpr double seconds_per_minute = 60;
}

void SimulatedSpindle::configure(double acceleration, double period) {
  period_ = period;
  speed_step_ = acceleration / 6 * period;  // deg/s2 to 1/min per period
}

void SimulatedSpindle::step(const SpindleSetpoint& setpoint, bool powered) {
  double demand = powered ? setpoint.speed : 0;
  if (setpoint.coupled && powered) demand = (setpoint.angle - angle_) / period_ * seconds_per_minute;
  speed_ += std::clamp(demand - speed_, -speed_step_, speed_step_);
  angle_ += speed_ / seconds_per_minute * period_;
}

}  // namespace trunnion::drive
