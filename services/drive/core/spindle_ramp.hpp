// SPDX-License-Identifier: Apache-2.0
// The speed reference of a spindle whose acceleration falls with its speed (10a971 .. 10a973).
#pragma once

#include <cstdint>

#include "machine/parameters.hpp"

namespace trunnion::drive {

struct RampSettings {
  double acceleration = 0;       ///< deg/s2, up to the base speed: 10a036
  bool speed_dependent = false;  ///< 10a971
  double base_speed = 0;         ///< 1/min: 10a972
  double power_speed = 0;        ///< 1/min: 10a973

  /// The base speed is above 0 and not above the power speed, where they are in force.
  bool usable() const { return !speed_dependent || (base_speed > 0 && power_speed >= base_speed); }
};
/// Of the spindle with a logical number.
RampSettings ramp_settings(const machine::Parameters& parameters, std::uint16_t spindle);

/// deg/s2 at `speed` (1/min, of either sign): constant up to the base speed (constant torque), falling with
/// the speed up to the power speed (constant power), above it with its square. 0 with settings that are not
/// usable.
double acceleration_at(const RampSettings& settings, double speed);

/// Without 10a971 the reference is what is demanded, and the spindle accelerates as it can by itself.
class SpindleRamp {
 public:
  /// `period` s. Not cyclic.
  void configure(const RampSettings& settings, double period);
  const RampSettings& settings() const { return settings_; }
  /// One period: the reference, 1/min. `demand` is the commanded speed while the ramp is `active`, otherwise
  /// the speed the spindle has, from which the ramp begins.
  double step(double demand, bool active);
  double reference() const { return reference_; }

  /// No fields, configure() sets them: settings_, period_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("reference", self.reference_);
  }

 private:
  double change(double speed) const;

  RampSettings settings_;
  double period_ = 0.001;
  double reference_ = 0;
};

}  // namespace trunnion::drive
