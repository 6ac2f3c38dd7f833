// SPDX-License-Identifier: Apache-2.0
// Turns a spindle to an angle and holds it there (M19): the angle that it follows, from any speed.
#pragma once

#include <cstdint>
#include <type_traits>

#include "drive_hardware.hpp"

namespace trunnion::drive {

struct OrientationSettings {
  double angle = 0;         ///< deg, clockwise, from the index mark: 10a945
  double window = 0.1;      ///< deg: 10a946
  double speed = 100;       ///< 1/min of the approach: 10a947
  double acceleration = 0;  ///< deg/s2 at that speed
};
/// Of the spindle with a logical number.
OrientationSettings orientation_settings(const machine::Parameters& parameters, std::uint16_t spindle);

/// Periods for which a held spindle is out of its window before that is an alarm.
inline constexpr std::uint32_t orientation_lost_periods = 20;

/// A spindle that turns slows down to the speed of the approach by itself and keeps its direction; one at
/// rest takes the shorter way. One that is not homed turns at the speed of the approach until its index mark
/// has passed. The approach changes its speed within a share of the spindle's acceleration, so that it can
/// follow.
class SpindleOrientation {
 public:
  void configure(const OrientationSettings& settings, double period);
  /// deg/s2 that the approach keeps to besides its own: of the spindles that follow this one. Until the next
  /// configure().
  void limit_acceleration(double acceleration);
  /// 1/min.
  double approach_speed() const { return own_speed_; }
  /// `angle` deg; below 0: that of the settings.
  void demand(bool on, double angle = -1);
  bool demanded() const { return demanded_; }
  /// One period: the setpoint that replaces `setpoint`. A coupled spindle (tapping) is left alone, and one
  /// that is not `controlled` begins anew afterwards.
  SpindleSetpoint step(const SpindleSetpoint& setpoint, const SpindleStatus& status, bool controlled);
  /// It is held and within the window.
  bool oriented(const SpindleStatus& status) const;
  /// 1/min, of the angle that it follows; 0 while it follows none.
  double speed() const;
  /// deg: the demanded angle.
  double angle() const;
  /// In the period of the last step() a held spindle has been out of its window for orientation_lost_periods,
  /// once each time it leaves it.
  bool lost() const { return outside_ == orientation_lost_periods; }
  /// In the period of the last step() it has been on its way for time_limit(), once for each angle: it is
  /// blocked, does not slow down, or its index mark does not pass.
  bool late() const { return waited_ == late_periods_; }
  /// s
  double time_limit() const { return late_periods_ * period_; }
  /// The alarms are reset: a spindle that is still out of its window, or on its way, is lost or late again.
  void acknowledge() { outside_ = waited_ = 0; }

  /// No fields, configure() sets them: period_, reference_, window_, approach_speed_, speed_step_, own_step_,
  /// own_speed_, late_periods_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("demanded", self.demanded_), visit("active", self.active_), visit("angle", self.angle_);
    visit("speed", self.speed_), visit("target", self.target_);
    if (!std::is_const_v<Self> || self.ordered_ >= 0) visit("ordered", self.ordered_);
    if (!std::is_const_v<Self> || self.arriving_) visit("arriving", self.arriving_);
    if (!std::is_const_v<Self> || self.outside_ != 0) visit("outside", self.outside_);
    if (!std::is_const_v<Self> || self.waited_ != 0) visit("waited", self.waited_);
  }

 private:
  double reference() const { return ordered_ >= 0 ? ordered_ : reference_; }
  bool at_target() const;
  bool within_window(const SpindleStatus& status) const;
  void watch(const SpindleStatus& status);
  void choose_target();
  void approach();

  double period_ = 0.001, reference_ = 0, window_ = 0;  // s, rev, rev
  double approach_speed_ = 0, speed_step_ = 0;          // rev of a period
  double own_step_ = 0;                                 // speed_step_ of a spindle that none follows
  double own_speed_ = 0;                                // 1/min, of the approach
  bool demanded_ = false, active_ = false;
  double angle_ = 0, speed_ = 0, target_ = 0;  // rev, rev of a period, rev
  double ordered_ = -1;                        // rev: in place of reference_; below 0 = none
  bool arriving_ = false;                      // its angle has arrived, the spindle not yet
  std::uint32_t outside_ = 0;                  // periods, one more than those of lost() at most
  std::uint32_t waited_ = 0;                   // periods on its way, one more than late_periods_ at most
  std::uint32_t late_periods_ = 1;
};

}  // namespace trunnion::drive
