// SPDX-License-Identifier: Apache-2.0
#include "spindle_orientation.hpp"

#include <algorithm>
#include <cmath>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {
namespace {

constexpr double acceleration_share = 0.9;   // of what the spindle can, for its control
constexpr double approach_tolerance = 1.05;  // share of the speed of the approach at which it begins
constexpr double at_target = 1e-9;           // rev
constexpr double degrees = 360, seconds_of_minute = 60;

}  // namespace

OrientationSettings orientation_settings(const machine::Parameters& parameters, std::uint16_t spindle) {
  return {parameters.get(parameter::orientation_angle, spindle),
          parameters.get(parameter::orientation_window, spindle),
          parameters.get(parameter::orientation_speed, spindle),
          parameters.get(parameter::maximum_acceleration, spindle)};
}

void SpindleOrientation::configure(const OrientationSettings& settings, double period) {
  period_ = period;
  const double reference = settings.angle / degrees;
  if (reference != reference_) active_ = false;  // a held spindle turns to the other angle
  reference_ = reference;
  window_ = settings.window / degrees;
  approach_speed_ = settings.speed / seconds_of_minute * period;
  speed_step_ = acceleration_share * settings.acceleration / degrees * period * period;
}

SpindleSetpoint SpindleOrientation::step(const SpindleSetpoint& setpoint, const SpindleStatus& status,
                                         bool controlled) {
  if (!demanded_ || setpoint.coupled || !controlled || speed_step_ <= 0) {
    active_ = false;
    return setpoint;
  }
  if (!active_) {
    speed_ = status.speed / seconds_of_minute * period_;
    if (std::abs(speed_) > approach_tolerance * approach_speed_)
      return {std::copysign(approach_speed_ / period_ * seconds_of_minute, speed_), false, 0};
    active_ = true;
    angle_ = status.angle;
    choose_target();
  }
  approach();
  angle_ += speed_;
  return {0, true, angle_};
}

// A turning spindle needs some way to stop: the next passage of the angle behind it.
void SpindleOrientation::choose_target() {
  const double from = angle_ - reference_;
  if (std::abs(speed_) < speed_step_) {
    target_ = std::round(from) + reference_;
    return;
  }
  const double way = speed_ * speed_ / (2 * speed_step_) + 2 * std::abs(speed_);
  target_ = speed_ > 0 ? std::ceil(from + way) + reference_ : std::floor(from - way) + reference_;
}

// The fastest speed v from which steps of `a` still end at the target: v + (v - a) + (v - 2 a) ... <=
// distance.
void SpindleOrientation::approach() {
  const double distance = target_ - angle_;
  const double a = speed_step_;
  const double fastest = std::min(
      {a * (std::sqrt(0.25 + 2 * std::abs(distance) / a) - 0.5), approach_speed_, std::abs(distance)});
  const double wanted = std::copysign(fastest, distance);
  speed_ = std::clamp(wanted, speed_ - a, speed_ + a);
  // The last part of a step, which the square root only comes near to.
  if (std::abs(distance) <= a && std::abs(speed_) <= a) speed_ = distance;
}

bool SpindleOrientation::oriented(const SpindleStatus& status) const {
  return active_ && std::abs(speed_) <= at_target && std::abs(angle_ - target_) <= at_target &&
         std::abs(status.angle - target_) <= window_;
}

}  // namespace trunnion::drive
