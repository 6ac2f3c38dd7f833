// SPDX-License-Identifier: Apache-2.0
#include "spindle_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "machine/parameter_constants.hpp"
#include "spindle_ramp.hpp"
#include "timeouts.hpp"

namespace trunnion::drive {
namespace {

constexpr double acceleration_share = 0.9;   // of what the spindle can, for its control
constexpr double approach_tolerance = 1.05;  // share of the speed of the approach at which it begins
constexpr double no_distance = 1e-9;         // rev
constexpr double degrees = 360, seconds_of_minute = 60;
constexpr double turns_of_approach = 2;  // to the index mark and to the angle

}  // namespace

OrientationSettings orientation_settings(const machine::Parameters& parameters, std::uint16_t spindle) {
  const double speed = parameters.get(parameter::orientation_speed, spindle);
  return {parameters.get(parameter::orientation_angle, spindle),
          parameters.get(parameter::orientation_window, spindle), speed,
          acceleration_at(ramp_settings(parameters, spindle), speed)};
}

void SpindleOrientation::configure(const OrientationSettings& settings, double period) {
  period_ = period;
  const double before = reference();
  reference_ = settings.angle / degrees;
  if (reference() != before) active_ = false;  // a held spindle turns to the other angle
  window_ = settings.window / degrees;
  own_speed_ = settings.speed;
  approach_speed_ = settings.speed / seconds_of_minute * period;
  speed_step_ = own_step_ = acceleration_share * settings.acceleration / degrees * period * period;
  const double limit = orientation_timeout + turns_of_approach * seconds_of_minute / settings.speed;
  const auto periods = static_cast<std::uint32_t>(std::llround(limit / period));
  if (periods != std::exchange(late_periods_, periods)) waited_ = 0;
}

void SpindleOrientation::limit_acceleration(double acceleration) {
  speed_step_ = std::min(own_step_, acceleration_share * acceleration / degrees * period_ * period_);
}

void SpindleOrientation::demand(bool on, double angle) {
  demanded_ = on;
  const double before = reference();
  ordered_ = angle >= 0 ? angle / degrees : -1;
  if (reference() == before) return;
  active_ = false;
  waited_ = 0;
}

SpindleSetpoint SpindleOrientation::step(const SpindleSetpoint& setpoint, const SpindleStatus& status,
                                         bool controlled) {
  if (!demanded_ || setpoint.coupled || !controlled || speed_step_ <= 0) {
    active_ = arriving_ = false;
    outside_ = waited_ = 0;
    return setpoint;
  }
  watch(status);
  if (!active_) {
    speed_ = status.speed / seconds_of_minute * period_;
    if (!status.homed || std::abs(speed_) > approach_tolerance * approach_speed_)
      return {std::copysign(approach_speed_ / period_ * seconds_of_minute, speed_), false, 0};
    active_ = true;
    angle_ = status.angle;
    choose_target();
  }
  const bool arrived = at_target();
  approach();
  angle_ += speed_;
  if (!arrived && at_target()) arriving_ = true;
  return {0, true, angle_};
}

// Of the period that has passed. A spindle that has not come into its window yet has not left it.
void SpindleOrientation::watch(const SpindleStatus& status) {
  const bool held = active_ && at_target();
  if (held && within_window(status))
    waited_ = 0;
  else if ((!held || arriving_) && waited_ <= late_periods_)
    ++waited_;
  if (!held || within_window(status)) {
    arriving_ = false;
    outside_ = 0;
  } else if (!arriving_ && outside_ <= orientation_lost_periods) {
    ++outside_;
  }
}

// A turning spindle needs some way to stop: the next passage of the angle behind it.
void SpindleOrientation::choose_target() {
  const double from = angle_ - reference();
  if (std::abs(speed_) < speed_step_) {
    target_ = std::round(from) + reference();
    return;
  }
  const double way = speed_ * speed_ / (2 * speed_step_) + 2 * std::abs(speed_);
  target_ = speed_ > 0 ? std::ceil(from + way) + reference() : std::floor(from - way) + reference();
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

bool SpindleOrientation::at_target() const {
  return std::abs(speed_) <= no_distance && std::abs(angle_ - target_) <= no_distance;
}

bool SpindleOrientation::within_window(const SpindleStatus& status) const {
  return std::abs(status.angle - target_) <= window_;
}

bool SpindleOrientation::oriented(const SpindleStatus& status) const {
  return active_ && at_target() && within_window(status);
}

double SpindleOrientation::speed() const { return active_ ? speed_ / period_ * seconds_of_minute : 0; }

double SpindleOrientation::angle() const { return reference() * degrees; }

}  // namespace trunnion::drive
