// SPDX-License-Identifier: Apache-2.0
#include "elastic_axis.hpp"

#include <algorithm>

namespace trunnion::drive {

void ElasticAxis::configure(const truth::DriveTruth& truth, const ServoParameters& parameters) {
  p_ = parameters;
  truth_ = truth;
  if (!truth_.mechanics) {
    // Encoders alone: stiff mechanics with the friction of the parameters.
    truth_.mechanics.emplace();
    truth_.mechanics->locked_frequency = 300;
    truth_.mechanics->damping_ratio = 0.3;
    truth_.mechanics->coulomb = truth_.mechanics->breakaway = p_.coulomb;
    truth_.mechanics->viscous = p_.viscous / p_.rapid;
    truth_.mechanics->backlash = p_.backlash;
  }
  if (p_.full_closed_loop && !truth_.load) truth_.load.emplace();
  plant_.configure(*truth_.mechanics, p_.inertia, p_.rated_torque);
  motor_.configure(truth_.motor);
  const auto load = truth_.load.value_or(truth::EncoderTruth{});
  load_.configure(load);
  load_factor_ = p_.load_sign;
  dual_loop_time_ = p_.dual_loop_time;
  if (p_.load_pulses > 0) load_factor_ *= p_.travel_per_revolution / (p_.load_pulses * load.resolution);
}

void ElasticAxis::place(double position) {
  plant_.place(position);
  if (full_closed()) plant_.place(position + (position - plant_.load()));
  motor_.start(plant_.motor());
  load_.start(plant_.load());
  offset_ = 0;
  homed_ = (full_closed() ? load_ : motor_).reference().has_value();
  loop_.preload(p_, plant_.holding_torque());
  difference_ = slip_ = motor_.reading() - load_reading();
  command_ = encoder();
}

void ElasticAxis::hold() {
  plant_.stop();
  loop_.preload(p_, plant_.holding_torque());
  read();
  slip_ = motor_.reading() - load_reading();
  command_ = encoder();
}

void ElasticAxis::set_reference(double shift) {
  offset_ += shift;
  command_ += shift;
  homed_ = true;
}

double ElasticAxis::encoder() const {
  if (!full_closed()) return motor_.reading() + offset_;
  return (dual_loop_time_ > 0 ? motor_.reading() - slip_ : load_reading()) + offset_;
}

double ElasticAxis::encoder_difference() const {
  return truth_.load ? motor_.reading() - load_reading() - difference_ : 0;
}

void ElasticAxis::read() {
  motor_.move(plant_.motor());
  if (truth_.load) load_.move(plant_.load());
}

void ElasticAxis::begin(const AxisSetpoint& setpoint, double dt, LoopTest* test) {
  setpoint_ = setpoint;
  h_ = dt / servo_substeps;
  // The parabola of ServoAxis::begin().
  start_velocity_ = setpoint.velocity - setpoint.acceleration * dt / 2;
  test_ = test;
}

void ElasticAxis::substep(int i, const PartnerInput& partner) {
  const double h = h_, acceleration = setpoint_.acceleration, velocity = start_velocity_;
  const double sign = truth_.motor.inverted ? -1 : 1;
  // Encoders that no loop needs are read once a period.
  const bool motor_read = !full_closed() || dual_loop_time_ > 0 || test_ != nullptr;
  const bool load_read = truth_.load && (full_closed() || test_ != nullptr);
  const ServoParameters& p = test_ != nullptr ? test_->parameters() : p_;
  dual_loop_time_ = p.dual_loop_time;
  const double t = i * h;
  const double set = command_ + (velocity + acceleration * t / 2) * t;
  const double feedback = encoder(), speed = sign * plant_.motor_speed();
  LoopInput in{set - feedback, velocity + acceleration * t, acceleration, speed};
  position_error_ = in.position_error;
  if (truth_.load)
    in.load_velocity = (truth_.load->inverted ? -load_factor_ : load_factor_) * plant_.load_speed() - speed;
  double excitation = 0;
  LoopSample sample;
  if (test_ != nullptr) {
    excitation = test_->excitation();
    if (test_->of_speed())
      in.speed_excitation = excitation;
    else
      in.torque_excitation = excitation * p_.rated_torque;
    const double motor = motor_.reading() + offset_;
    sample = {set, feedback, 0, speed, 0, excitation, motor, truth_.load ? load_reading() + offset_ : motor};
  }
  if (partner.speed_correction != 0) in.speed_excitation += partner.speed_correction;
  const double torque = partner.torque_follow ? loop_.follow(p, partner.torque, h) : loop_.step(p, in, h);
  plant_.step(torque, h, partner.force);
  if (load_read) load_.move(plant_.load());
  if (motor_read) motor_.move(plant_.motor());
  if (p.dual_loop_time > 0)
    slip_ += (motor_.reading() - load_reading() - slip_) * std::min(1.0, h / p.dual_loop_time);
  if (test_ != nullptr) {
    sample.speed_set = loop_.speed_set(), sample.torque = torque / p_.rated_torque;
    test_->sample(sample);
  }
}

void ElasticAxis::end() {
  dual_loop_time_ = p_.dual_loop_time;
  read();
  if (!(dual_loop_time_ > 0)) slip_ = motor_.reading() - load_reading();
  command_ = setpoint_.position;
}

void ElasticAxis::run_out(RunOut way, double h, double force) {
  const double speed = plant_.motor_speed(), most = p_.rated_torque;
  const double torque = way == RunOut::brakes ? std::clamp(-speed * p_.inertia / h, -most, most) : 0;
  loop_.clear();
  plant_.step(torque, h, force);
  read();
  slip_ = motor_.reading() - load_reading();
  command_ = encoder();
}

}  // namespace trunnion::drive
