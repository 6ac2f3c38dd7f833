// SPDX-License-Identifier: Apache-2.0
#include "servo_axis.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::drive {

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

void ServoAxis::begin(const AxisSetpoint& setpoint, double dt, LoopTest* test) {
  setpoint_ = setpoint;
  h_ = dt / servo_substeps;
  // The differences of the setpoints are the velocity in the middle of the period and the acceleration at its
  // beginning: the parabola through both ends with these.
  start_velocity_ = setpoint.velocity - setpoint.acceleration * dt / 2;
  test_ = test;
}

void ServoAxis::substep(int i, const PartnerInput& partner) {
  const double h = h_, acceleration = setpoint_.acceleration, velocity = start_velocity_;
  const double t = i * h;
  const double set = command_ + (velocity + acceleration * t / 2) * t;
  LoopInput in{set - position_, velocity + acceleration * t, acceleration, velocity_};
  position_error_ = in.position_error;
  const double excitation = test_ != nullptr ? test_->excitation() : 0;
  if (test_ != nullptr && test_->of_speed())
    in.speed_excitation = excitation;
  else
    in.torque_excitation = excitation * p_.rated_torque;
  if (partner.speed_correction != 0) in.speed_excitation += partner.speed_correction;
  const double position = position_, speed = velocity_;
  const double torque = partner.torque_follow
                            ? loop_.follow(p_, partner.torque, h)
                            : loop_.step(test_ != nullptr ? test_->parameters() : p_, in, h);
  const double change = (torque - friction() + partner.force) / p_.inertia * h;
  position_ += (velocity_ + change / 2) * h;
  velocity_ += change;
  if (test_ != nullptr)
    test_->sample(
        {set, position, loop_.speed_set(), speed, torque / p_.rated_torque, excitation, position, position});
}

void ServoAxis::end() {
  command_ = setpoint_.position;
  read();
}

void ServoAxis::read() {
  load_ = std::clamp(load_, position_ - p_.backlash / 2, position_ + p_.backlash / 2);
  encoder_ = std::round(position_ / p_.resolution) * p_.resolution;
}

double ServoAxis::friction() const {
  // Coulomb friction is steep rather than a step around standstill, so that the solution does not chatter.
  constexpr double steep = 0.05;  // mm/s or deg/s
  return p_.rated_torque *
         (p_.coulomb * std::clamp(velocity_ / steep, -1.0, 1.0) + p_.viscous * velocity_ / p_.rapid);
}

void ServoAxis::run_out(RunOut way, double h, double force) {
  loop_.clear();
  const double most = p_.rated_torque;
  const double torque = way == RunOut::brakes ? std::clamp(-velocity_ * p_.inertia / h, -most, most) : 0;
  const double change = (torque - friction() + force) / p_.inertia * h;
  position_ += (velocity_ + change / 2) * h;
  velocity_ += change;
  command_ = position_;
  read();
}

}  // namespace trunnion::drive
