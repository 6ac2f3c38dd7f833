// SPDX-License-Identifier: Apache-2.0
// A simulated spindle: turns at a speed, or follows an angle, within its acceleration.
#pragma once

#include "drive_hardware.hpp"

namespace trunnion::drive {

/// Angles are revolutions, clockwise positive, turns counted; speeds 1/min.
class SimulatedSpindle {
 public:
  /// `acceleration` deg/s2, `period` s.
  void configure(double acceleration, double period);
  /// One period; `powered` is false when the drives are off, and the spindle runs down.
  void step(const SpindleSetpoint& setpoint, bool powered);

  double speed() const { return speed_; }
  double angle() const { return angle_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("speed", self.speed_);
    visit("angle", self.angle_);
  }

 private:
  double period_ = 0.001, speed_step_ = 0;
  double speed_ = 0, angle_ = 0;
};

}  // namespace trunnion::drive
