// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/servo_settings.hpp"

#include "machine/parameter_constants.hpp"

namespace trunnion::servo_analysis {
namespace {

// Of all settings: the parameter and its member.
template <class Settings, class Visit>
void each(Settings& s, Visit&& visit) {
  visit(parameter::position_gain, s.position_gain);
  visit(parameter::speed_gain, s.speed_gain);
  visit(parameter::speed_integral_time, s.speed_integral_time);
  visit(parameter::velocity_feedforward, s.velocity_feedforward);
  visit(parameter::acceleration_feedforward, s.acceleration_feedforward);
  visit(parameter::dual_loop_time, s.dual_loop_time);
  visit(parameter::damping_gain, s.damping_gain);
  visit(parameter::torque_filter_time, s.torque_filter_time);
  visit(parameter::notch_frequency, s.notch_frequency);
  visit(parameter::notch_width, s.notch_width);
  visit(parameter::friction_compensation, s.friction_compensation);
}

}  // namespace

ServoSettings ServoSettings::from(const machine::Parameters& parameters, std::uint32_t axis) {
  ServoSettings s;
  each(s, [&](const auto& parameter, double& value) { value = parameters.get(parameter, axis); });
  return s;
}

std::vector<ServoSettings::Value> ServoSettings::values(std::uint32_t axis) const {
  std::vector<Value> all;
  each(*this, [&](const auto& parameter, double value) { all.push_back({parameter.number(axis), value}); });
  return all;
}

}  // namespace trunnion::servo_analysis
