// SPDX-License-Identifier: Apache-2.0
#include "servo_axis.hpp"

#include <algorithm>
#include <cmath>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

ServoParameters ServoParameters::from(const machine::Parameters& p, std::uint32_t axis) {
  ServoParameters s;
  const double acceleration = p.get(parameter::maximum_acceleration, axis);
  s.position_gain = p.get(parameter::position_gain, axis);
  s.speed_gain = p.get(parameter::speed_gain, axis);
  s.speed_integral_time = p.get(parameter::speed_integral_time, axis) / 1000;
  s.current_time_constant = p.get(parameter::current_time_constant, axis) / 1000;
  s.velocity_feedforward = p.get(parameter::velocity_feedforward, axis);
  s.acceleration_feedforward = p.get(parameter::acceleration_feedforward, axis);
  // The motor is chosen for a load of its own inertia: three times the programmed acceleration at its peak.
  s.inertia = (1 + p.get(parameter::load_inertia_ratio, axis)) / 2;
  s.rated_torque = 1.5 * acceleration;
  s.peak_torque = 3 * acceleration;
  s.coulomb = p.get(parameter::coulomb_friction, axis);
  s.viscous = p.get(parameter::viscous_friction, axis);
  s.rapid = p.get(parameter::rapid_feed, axis) / 60;
  s.resolution = p.get(parameter::encoder_resolution, axis) * 1e-6;
  s.backlash = p.get(parameter::mechanical_backlash, axis);
  return s;
}

void ServoAxis::place(double position) {
  command_ = position_ = encoder_ = load_ = position;
  velocity_ = 0;
  loop_.clear();
}

void ServoAxis::hold() {
  command_ = position_;
  velocity_ = 0;
  loop_.clear();
}

void ServoAxis::step(const AxisSetpoint& setpoint, double dt) {
  const double h = dt / substeps;
  // The differences of the setpoints are the velocity in the middle of the period and the acceleration at its
  // beginning: the parabola through both ends with these.
  const double acceleration = setpoint.acceleration;
  const double velocity = setpoint.velocity - acceleration * dt / 2;
  for (int i = 0; i < substeps; ++i) {
    const double t = i * h;
    const double set = command_ + (velocity + acceleration * t / 2) * t;
    const double torque =
        loop_.step(p_, set - position_, velocity + acceleration * t, acceleration, velocity_, h);
    // Coulomb friction is steep rather than a step around standstill, so that the solution does not chatter.
    constexpr double steep = 0.05;  // mm/s or deg/s
    const double friction = p_.rated_torque * (p_.coulomb * std::clamp(velocity_ / steep, -1.0, 1.0) +
                                               p_.viscous * velocity_ / p_.rapid);
    const double change = (torque - friction) / p_.inertia * h;
    position_ += (velocity_ + change / 2) * h;
    velocity_ += change;
  }
  command_ = setpoint.position;
  load_ = std::clamp(load_, position_ - p_.backlash / 2, position_ + p_.backlash / 2);
  encoder_ = std::round(position_ / p_.resolution) * p_.resolution;
}

}  // namespace trunnion::drive
