// SPDX-License-Identifier: Apache-2.0
// A simulated spindle: turns at a speed, or follows an angle, within its acceleration and, where truth.yaml
// has a motor, the torque of that.
#pragma once

#include <cstdint>
#include <type_traits>

#include "drive_hardware.hpp"
#include "truth/drive_truth.hpp"

namespace trunnion::drive {

struct SimulatedSpindleSettings {
  double acceleration = 0;  ///< deg/s2: 10a036
  double lag = 0;           ///< s, time constant of the speed loop: 10a978
};

/// Angles are revolutions, clockwise positive, turns counted; speeds 1/min. The lag of its speed loop and the
/// error of its speed are those of a spindle that has a speed; one that follows an angle is controlled by
/// that.
class SimulatedSpindle {
 public:
  /// `period` s. `truth`: what it really does, or null for a spindle that is ideal and always strong enough;
  /// it must outlive the spindle. The first call says where its index mark is.
  void configure(const SimulatedSpindleSettings& settings, double period,
                 const truth::SpindleTruth* truth = nullptr);
  /// `acceleration` deg/s2.
  void configure(double acceleration, double period, const truth::SpindleTruth* truth = nullptr) {
    configure(SimulatedSpindleSettings{acceleration, 0}, period, truth);
  }
  /// One period; `powered` is false when the drives are off, and the spindle runs down.
  void step(const SpindleSetpoint& setpoint, bool powered);

  double speed() const { return speed_ * ripple(); }
  double angle() const { return angle_; }
  SpindleStatus status() const { return {speed(), angle_, homed_, torque_}; }

  /// No fields, configure() sets them: truth_, period_, speed_step_, lag_share_, placed_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("speed", self.speed_);
    visit("angle", self.angle_);
    // Written where there is something: recordings of ideal spindles have no such state.
    if (!std::is_const_v<Self> || self.coupled_) {
      visit("coupled", self.coupled_), visit("followed", self.followed_);
    }
    if (!std::is_const_v<Self> || self.has_mark()) {
      visit("homed", self.homed_), visit("mark", self.mark_);
      visit("passed", self.passed_);
    }
    if (!std::is_const_v<Self> || self.torque_ != 0) visit("torque", self.torque_);
    if (!std::is_const_v<Self> || self.has_ripple()) visit("periods", self.periods_);
  }

 private:
  bool has_mark() const { return truth_ != nullptr && truth_->mark.has_value(); }
  bool has_ripple() const { return truth_ != nullptr && truth_->ripple != 0; }
  double ripple() const;
  double truly(double speed) const;
  void step_ideal(const SpindleSetpoint& setpoint, bool powered);
  void step_motor(const SpindleSetpoint& setpoint, bool powered);
  double loaded_change(double wanted, double most) const;
  void turn(bool coupled);

  const truth::SpindleTruth* truth_ = nullptr;
  double period_ = 0.001, speed_step_ = 0;
  double lag_share_ = 1;  // of the deviation that the speed loop makes up in a period
  bool placed_ = false;
  double speed_ = 0, angle_ = 0;  // without the ripple; of the encoder
  bool coupled_ = false;          // with a motor: in the period before
  double followed_ = 0;           // and the angle it followed
  // Until it is homed the index mark is at `mark_` and every revolution from there.
  bool homed_ = true, passed_ = false;
  double mark_ = 0;
  double torque_ = 0;
  std::uint64_t periods_ = 0;  // of the ripple
};

}  // namespace trunnion::drive
