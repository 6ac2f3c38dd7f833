// SPDX-License-Identifier: Apache-2.0
// The control loops of a servo drive: position P, speed PI, current lag. Units as in ServoAxis.
#pragma once

#include <algorithm>

#include "servo_parameters.hpp"

namespace trunnion::drive {

class ServoLoop {
 public:
  void clear() { torque_ = integral_ = 0; }
  /// The torque that holds an axis at rest against a constant load.
  void preload(double torque) { torque_ = integral_ = torque; }

  /// One step of `h` s: the torque. `velocity_set` and `acceleration` are the feed-forward.
  double step(const ServoParameters& p, double position_error, double velocity_set, double acceleration,
              double velocity, double h) {
    const double speed_set = p.position_gain * position_error + p.velocity_feedforward * velocity_set;
    const double speed_error = speed_set - velocity;
    const double demand = p.speed_gain * speed_error + integral_ + p.acceleration_feedforward * acceleration;
    const double limited = std::clamp(demand, -p.peak_torque, p.peak_torque);
    // The integrator stops while the torque is at its limit, so that it does not wind up.
    if (p.speed_integral_time > 0 && demand == limited)
      integral_ += p.speed_gain / p.speed_integral_time * speed_error * h;
    torque_ += (limited - torque_) * std::min(1.0, h / p.current_time_constant);
    return torque_;
  }
  double torque() const { return torque_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("torque", self.torque_);
    visit("integral", self.integral_);
  }

 private:
  double torque_ = 0, integral_ = 0;
};

}  // namespace trunnion::drive
