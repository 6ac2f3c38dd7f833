// SPDX-License-Identifier: Apache-2.0
#include "simulated_spindle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angle.hpp"

namespace trunnion::drive {
namespace {
constexpr double seconds_per_minute = 60;
constexpr double degrees_per_turn = 360;
}  // namespace

void SimulatedSpindle::configure(const SimulatedSpindleSettings& settings, double period,
                                 const truth::SpindleTruth* truth) {
  truth_ = truth;
  period_ = period;
  speed_step_ = settings.acceleration / 6 * period;  // deg/s2 to 1/min per period
  // Half a period from the bilinear transform: the time constant is that of the settings.
  lag_share_ = settings.lag > period / 2 ? period / (settings.lag + period / 2) : 1;
  if (!placed_ && has_mark()) {
    homed_ = false;
    mark_ = *truth_->mark / degrees_per_turn;
  }
  placed_ = true;
}

// Counted in periods, so that it has the same bits in every run.
double SimulatedSpindle::ripple() const {
  if (!has_ripple()) return 1;
  const double turns = truth_->ripple_frequency * (static_cast<double>(periods_) * period_);
  return 1 + truth_->ripple * geometry::sine_cosine(degrees_per_turn * (turns - std::floor(turns))).sine;
}

// The speed that a commanded one is.
double SimulatedSpindle::truly(double speed) const {
  return truth_ == nullptr || truth_->speed_error == 0 ? speed : speed * (1 + truth_->speed_error);
}

void SimulatedSpindle::step(const SpindleSetpoint& setpoint, bool powered) {
  if (truth_ != nullptr && truth_->has_motor())
    step_motor(setpoint, powered);
  else
    step_ideal(setpoint, powered);
}

void SimulatedSpindle::step_ideal(const SpindleSetpoint& setpoint, bool powered) {
  double demand = powered ? truly(setpoint.speed) : 0;
  double share = powered ? lag_share_ : 1;
  const bool coupled = setpoint.coupled && powered;
  if (coupled) demand = (setpoint.angle - angle_) / period_ * seconds_per_minute, share = 1;
  speed_ += std::clamp((demand - speed_) * share, -speed_step_, speed_step_);
  turn(coupled);
}

void SimulatedSpindle::step_motor(const SpindleSetpoint& setpoint, bool powered) {
  const double torque = truth_->torque_at(speed_, setpoint.gear);
  const double most = torque / truth_->inertia;        // rad/s2
  const double turns = most / (2 * std::numbers::pi);  // rev/s2
  double demand = powered ? truly(setpoint.speed) : 0;
  double share = powered ? lag_share_ : 1;
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
    share = 1;
    followed_ = setpoint.angle;
  }
  coupled_ = coupled;
  const double before = speed_;
  const double step = turns * seconds_per_minute * period_;
  const double wanted = (demand - speed_) * share;
  speed_ += truth_->load_torque == 0
                ? std::clamp(wanted, -std::min(speed_step_, step), std::min(speed_step_, step))
                : loaded_change(wanted, step);
  const double acceleration = (speed_ - before) / seconds_per_minute / period_ * 2 * std::numbers::pi;
  const double load = speed_ > 0 ? truth_->load_torque : speed_ < 0 ? -truth_->load_torque : 0;
  torque_ = powered ? std::min(std::abs(truth_->inertia * acceleration + load) / torque, 1.0) : 0;
  turn(coupled);
}

// The load acts against the rotation. It takes its part of the torque while the spindle speeds up, helps to
// brake, and slows a motor down that is weaker. 1/min; `most`: of the motor in a period.
double SimulatedSpindle::loaded_change(double wanted, double most) const {
  const double direction = speed_ != 0 ? std::copysign(1.0, speed_) : std::copysign(1.0, wanted);
  const double load =
      truth_->load_torque / truth_->inertia / (2 * std::numbers::pi) * seconds_per_minute * period_;
  const double slower = std::min(speed_step_, most + load);
  const double faster = std::max(std::min(speed_step_, most - load), -slower);
  double change = std::clamp(direction * wanted, -slower, faster);
  // A load stops a spindle and does not turn it back.
  const double at = std::abs(speed_);
  if (at + change < 0 && at + direction * wanted >= 0) change = -at;
  return direction * change;
}

// The mark is passed in either direction. The count steps when nothing follows it.
void SimulatedSpindle::turn(bool coupled) {
  const double before = angle_;
  if (has_ripple()) ++periods_;
  angle_ += speed() / seconds_per_minute * period_;
  if (homed_) return;
  passed_ = passed_ || std::floor(before - mark_) != std::floor(angle_ - mark_);
  if (!passed_ || coupled) return;
  angle_ -= mark_;
  homed_ = true;
}

}  // namespace trunnion::drive
