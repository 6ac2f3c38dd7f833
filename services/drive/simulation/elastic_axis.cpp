// SPDX-License-Identifier: Apache-2.0
#include "elastic_axis.hpp"

#include "drive_hardware.hpp"

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
  plant_.configure(*truth_.mechanics, p_.inertia, p_.rated_torque);
  motor_.configure(truth_.motor);
  load_.configure(truth_.load.value_or(truth::EncoderTruth{}));
}

void ElasticAxis::place(double position) {
  plant_.place(position);
  if (truth_.load_feedback) plant_.place(position + (position - plant_.load()));
  motor_.start(plant_.motor());
  load_.start(plant_.load());
  offset_ = 0;
  homed_ = feedback().reference().has_value();
  loop_.preload(plant_.holding_torque());
  command_ = encoder();
}

void ElasticAxis::hold() {
  plant_.stop();
  loop_.preload(plant_.holding_torque());
  read();
  command_ = encoder();
}

void ElasticAxis::set_reference(double shift) {
  offset_ += shift;
  command_ += shift;
  homed_ = true;
}

double ElasticAxis::encoder() const { return feedback().reading() + offset_; }

void ElasticAxis::read() {
  motor_.move(plant_.motor());
  if (truth_.load) load_.move(plant_.load());
}

void ElasticAxis::step(const AxisSetpoint& setpoint, double dt) {
  const double h = dt / substeps;
  // The parabola of ServoAxis::step().
  const double acceleration = setpoint.acceleration;
  const double velocity = setpoint.velocity - acceleration * dt / 2;
  const double sign = truth_.motor.inverted ? -1 : 1;
  for (int i = 0; i < substeps; ++i) {
    const double t = i * h;
    const double set = command_ + (velocity + acceleration * t / 2) * t;
    const double torque = loop_.step(p_, set - encoder(), velocity + acceleration * t, acceleration,
                                     sign * plant_.motor_speed(), h);
    plant_.step(torque, h);
    truth_.load_feedback ? load_.move(plant_.load()) : motor_.move(plant_.motor());
  }
  read();
  command_ = setpoint.position;
}

}  // namespace trunnion::drive
