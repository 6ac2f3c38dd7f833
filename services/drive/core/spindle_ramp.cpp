// SPDX-License-Identifier: Apache-2.0
#include "spindle_ramp.hpp"

#include <cmath>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

RampSettings ramp_settings(const machine::Parameters& parameters, std::uint16_t spindle) {
  return {parameters.get(parameter::maximum_acceleration, spindle),
          parameters.integer(parameter::speed_dependent_acceleration, spindle) != 0,
          parameters.get(parameter::base_speed, spindle), parameters.get(parameter::power_speed, spindle)};
}

double acceleration_at(const RampSettings& settings, double speed) { return settings.at(speed); }

void SpindleRamp::configure(const RampSettings& settings, double period) {
  settings_ = settings;
  period_ = period;
}

// 1/min in a period: 6 deg/s are 1 1/min.
double SpindleRamp::change(double speed) const { return acceleration_at(settings_, speed) / 6 * period_; }

// The midpoint rule, exact below the base speed. Root and cube root would be exact above it, but the cube
// root has not the same bits in every C library.
double SpindleRamp::step(double demand, bool active) {
  if (!settings_.usable()) return reference_ = 0;
  if (!settings_.speed_dependent || !active) return reference_ = demand;
  const double distance = demand - reference_;
  const double direction = distance < 0 ? -1 : 1;
  const double way = change(reference_ + direction * change(reference_) / 2);
  if (std::abs(distance) <= way)
    reference_ = demand;
  else
    reference_ += direction * way;
  return reference_;
}

}  // namespace trunnion::drive
