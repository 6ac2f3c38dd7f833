// SPDX-License-Identifier: Apache-2.0
// How fast a spindle changes its speed (10a036), and how that falls with the speed (10a971 .. 10a973).
#pragma once

#include <cmath>

namespace trunnion::machine {

struct SpindleAcceleration {
  double acceleration = 0;       ///< deg/s2, up to the base speed: 10a036
  bool speed_dependent = false;  ///< 10a971
  double base_speed = 0;         ///< 1/min: 10a972
  double power_speed = 0;        ///< 1/min: 10a973

  /// The base speed is above 0 and not above the power speed, where they are in force.
  bool usable() const { return !speed_dependent || (base_speed > 0 && power_speed >= base_speed); }
  /// deg/s2 at `speed` (1/min, of either sign): constant up to the base speed (constant torque), falling with
  /// the speed up to the power speed (constant power), above it with its square. 0 when it is not usable.
  double at(double speed) const {
    if (!usable()) return 0;
    const double turns = std::abs(speed);
    if (!speed_dependent || turns <= base_speed) return acceleration;
    const double power = acceleration * (base_speed / turns);
    return turns <= power_speed ? power : power * (power_speed / turns);
  }
  bool operator==(const SpindleAcceleration&) const = default;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("acceleration", self.acceleration), visit("speed_dependent", self.speed_dependent);
    visit("base_speed", self.base_speed), visit("power_speed", self.power_speed);
  }
};

}  // namespace trunnion::machine
