// SPDX-License-Identifier: Apache-2.0
#include "simulated_spindle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::drive {
namespace {
constexpr double seconds_per_minute = 60;
}

void SimulatedSpindle::configure(double acceleration, double period, const truth::SpindleTruth* truth) {
  truth_ = truth;
  period_ = period;
  speed_step_ = acceleration / 6 * period;  // deg/s2 to 1/min per period
}

void SimulatedSpindle::step(const SpindleSetpoint& setpoint, bool powered) {
  if (truth_ != nullptr) return step_motor(setpoint, powered);
  double demand = powered ? setpoint.speed : 0;
  if (setpoint.coupled && powered) demand = (setpoint.angle - angle_) / period_ * seconds_per_minute;
  speed_ += std::clamp(demand - speed_, -speed_step_, speed_step_);
  angle_ += speed_ / seconds_per_minute * period_;
}

void SimulatedSpindle::step_motor(const SpindleSetpoint& setpoint, bool powered) {
  const double most = truth_->torque_at(speed_) / truth_->inertia;  // rad/s2
  const double turns = most / (2 * std::numbers::pi);               // rev/s2
  const double step = std::min(speed_step_, turns * seconds_per_minute * period_);
  double demand = powered ? setpoint.speed : 0;
  const bool coupled = powered && setpoint.coupled;
  if (coupled) {
    // The speed of the angle, and what makes up for the lag: not more than the motor can brake again.
    const double behind = (coupled_ ? followed_ : setpoint.angle) - angle_;
    const double advance = coupled_ ? setpoint.angle - followed_ : 0;
    // Its speed falls by 2 * slack in a period, so it brakes within the distance v^2 / (2 turns) + v period
    // / 2.
    const double slack = turns * period_ / 2;
    const double braking = std::sqrt(slack * slack + 2 * turns * std::abs(behind)) - slack;
    const double closing = std::min(std::abs(behind) / period_, braking);
    demand = (advance / period_ + std::copysign(closing, behind)) * seconds_per_minute;
    followed_ = setpoint.angle;
  }
  coupled_ = coupled;
  speed_ += std::clamp(demand - speed_, -step, step);
  angle_ += speed_ / seconds_per_minute * period_;
}

}  // namespace trunnion::drive
