// SPDX-License-Identifier: Apache-2.0
// The setpoint of one spindle: the speed the PLC demands, or an angle of the stream (tapping).
#pragma once

#include "drive_hardware.hpp"

namespace trunnion::drive {

/// Angles are revolutions, clockwise positive, turns counted; speeds 1/min.
class SpindleCoupling {
 public:
  void demand_speed(double speed) { setpoint_.speed = speed; }

  /// The setpoint of the cycle that is executed, counted from where the spindle was at the first one:
  /// `angle`.
  void couple(double revolutions, double angle);
  void release() { setpoint_.coupled = false; }
  /// A share `phase` of the distance from that setpoint to the one of the next cycle.
  void lead(double phase, double next_revolutions);
  /// Continues at the speed of the last setpoint for `cycles`, when there is no next one.
  void lead_on(double cycles) { setpoint_.angle += cycles * change_; }

  const SpindleSetpoint& setpoint() const { return setpoint_; }
  /// rev from the setpoint of the cycle before to that of the cycle that is executed, while coupled.
  double change() const { return change_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("setpoint", self.setpoint_);
    visit("origin", self.origin_);
    visit("target", self.target_);
    visit("change", self.change_);
  }

 private:
  SpindleSetpoint setpoint_;
  double origin_ = 0, target_ = 0, change_ = 0;
};

}  // namespace trunnion::drive
