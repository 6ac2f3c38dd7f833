// SPDX-License-Identifier: Apache-2.0
#include "servo_parameters.hpp"

#include <cmath>
#include <numbers>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

// R. Bristow-Johnson's formulas with the width B = w / Q: bilinear transform, warped at the centre.
NotchFilter NotchFilter::at(double frequency, double width, double h) {
  NotchFilter n;
  if (frequency <= 0 || frequency * h >= 0.5) return n;
  const double angle = 2 * std::numbers::pi * frequency * h;
  const double alpha = std::sin(angle) / 2 * (width / frequency);
  n.on = true;
  n.b0 = n.b2 = 1 / (1 + alpha);
  n.b1 = n.a1 = -2 * std::cos(angle) / (1 + alpha);
  n.a2 = (1 - alpha) / (1 + alpha);
  return n;
}

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
  s.torque_filter_time = p.get(parameter::torque_filter_time, axis) / 1000;
  s.notch = NotchFilter::at(p.get(parameter::notch_frequency, axis), p.get(parameter::notch_width, axis),
                            p.get(parameter::interpolation_cycle) * 1e-6 / servo_substeps);
  s.friction_compensation = p.get(parameter::friction_compensation, axis);
  s.damping_gain = p.get(parameter::damping_gain, axis);
  s.full_closed_loop = p.integer(parameter::full_closed_loop, axis) != 0;
  s.load_sign = p.integer(parameter::load_encoder_reversed, axis) != 0 ? -1 : 1;
  s.load_pulses = p.get(parameter::load_encoder_pulses, axis);
  // Pulses count as the scale does, whichever way the motor turns: load_sign alone says which.
  s.travel_per_revolution = std::abs(p.get(parameter::travel_per_revolution, axis)) / 1000;
  s.dual_loop_time = p.get(parameter::dual_loop_time, axis) / 1000;
  s.encoder_difference_limit = p.get(parameter::encoder_difference_limit, axis);
  return s;
}

}  // namespace trunnion::drive
