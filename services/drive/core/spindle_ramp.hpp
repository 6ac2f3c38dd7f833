// SPDX-License-Identifier: Apache-2.0
// The speed reference of a spindle whose acceleration falls with its speed (10a971 .. 10a973).
#pragma once

#include <cstdint>

#include "machine/parameters.hpp"
#include "machine/spindle_acceleration.hpp"

namespace trunnion::drive {

using RampSettings = machine::SpindleAcceleration;
/// Of the spindle with a logical number.
RampSettings ramp_settings(const machine::Parameters& parameters, std::uint16_t spindle);

/// deg/s2 at `speed` (1/min, of either sign); 0 with settings that are not usable.
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
