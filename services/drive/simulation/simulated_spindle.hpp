// SPDX-License-Identifier: Apache-2.0
// A simulated spindle: turns at a speed, or follows an angle, within its acceleration and, where truth.yaml
// has a motor, the torque of that.
#pragma once

#include <type_traits>

#include "drive_hardware.hpp"
#include "truth/drive_truth.hpp"

namespace trunnion::drive {

/// Angles are revolutions, clockwise positive, turns counted; speeds 1/min.
class SimulatedSpindle {
 public:
  /// `acceleration` deg/s2, `period` s. `truth`: its motor, or null for one that is always strong enough; it
  /// must outlive the spindle.
  void configure(double acceleration, double period, const truth::SpindleTruth* truth = nullptr);
  /// One period; `powered` is false when the drives are off, and the spindle runs down.
  void step(const SpindleSetpoint& setpoint, bool powered);

  double speed() const { return speed_; }
  double angle() const { return angle_; }

  /// No fields, configure() sets them: truth_, period_, speed_step_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("speed", self.speed_);
    visit("angle", self.angle_);
    // Written where there is something: recordings of ideal spindles have no such state.
    if (!std::is_const_v<Self> || self.coupled_) {
      visit("coupled", self.coupled_), visit("followed", self.followed_);
    }
  }

 private:
  void step_motor(const SpindleSetpoint& setpoint, bool powered);

  const truth::SpindleTruth* truth_ = nullptr;
  double period_ = 0.001, speed_step_ = 0;
  double speed_ = 0, angle_ = 0;
  bool coupled_ = false;  // with a truth: in the period before
  double followed_ = 0;   // and the angle it followed
};

}  // namespace trunnion::drive
