// SPDX-License-Identifier: Apache-2.0
// Turns a spindle to an angle and holds it there (M19): the angle that it follows, from any speed.
#pragma once

#include <cstdint>

#include "drive_hardware.hpp"

namespace trunnion::drive {

struct OrientationSettings {
  double angle = 0;         ///< deg, clockwise: 10a945
  double window = 0.1;      ///< deg: 10a946
  double speed = 100;       ///< 1/min of the approach: 10a947
  double acceleration = 0;  ///< deg/s2
};
/// Of the spindle with a logical number.
OrientationSettings orientation_settings(const machine::Parameters& parameters, std::uint16_t spindle);

/// A spindle that turns slows down to the speed of the approach by itself and keeps its direction; one at
/// rest takes the shorter way. The approach changes its speed within a share of the spindle's acceleration,
/// so that it can follow.
class SpindleOrientation {
 public:
  void configure(const OrientationSettings& settings, double period);
  void demand(bool on) { demanded_ = on; }
  /// One period: the setpoint that replaces `setpoint`. A coupled spindle (tapping) is left alone, and one
  /// that is not `controlled` begins anew afterwards.
  SpindleSetpoint step(const SpindleSetpoint& setpoint, const SpindleStatus& status, bool controlled);
  /// It is held and within the window.
  bool oriented(const SpindleStatus& status) const;

  /// No fields, configure() sets them: period_, reference_, window_, approach_speed_, speed_step_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("demanded", self.demanded_), visit("active", self.active_), visit("angle", self.angle_);
    visit("speed", self.speed_), visit("target", self.target_);
  }

 private:
  void choose_target();
  void approach();

  double period_ = 0.001, reference_ = 0, window_ = 0;  // s, rev, rev
  double approach_speed_ = 0, speed_step_ = 0;          // rev of a period
  bool demanded_ = false, active_ = false;
  double angle_ = 0, speed_ = 0, target_ = 0;  // rev, rev of a period, rev
};

}  // namespace trunnion::drive
