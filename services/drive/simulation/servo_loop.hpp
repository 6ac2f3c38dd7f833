// SPDX-License-Identifier: Apache-2.0
// The control loops of a servo drive: position P, speed PI, filters of the torque command, current lag.
// Units as in ServoAxis.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "servo_parameters.hpp"

namespace trunnion::drive {

/// What the loop has in one of its periods. Velocities and acceleration are feed-forward.
struct LoopInput {
  double position_error = 0, velocity_set = 0, acceleration = 0;
  double velocity = 0;          ///< of the motor
  double load_velocity = 0;     ///< less that of the motor; 0 without a load encoder
  double speed_excitation = 0;  ///< added to the setpoint of the speed loop
  double torque_excitation = 0;
};

class ServoLoop {
 public:
  void clear() { *this = {}; }
  /// The torque that holds an axis at rest against a constant load.
  void preload(const ServoParameters& p, double torque) {
    clear();
    torque_ = integral_ = filtered_ = torque;
    // The notch passes what is constant: its state is that of a constant input.
    notch_1_ = (1 - p.notch.b0) * torque, notch_2_ = (p.notch.b2 - p.notch.a2) * torque;
  }

  /// One step of `h` s: the torque.
  double step(const ServoParameters& p, const LoopInput& in, double h) {
    speed_set_ = p.position_gain * in.position_error + p.velocity_feedforward * in.velocity_set;
    if (in.speed_excitation != 0) speed_set_ += in.speed_excitation;
    const double speed_error = speed_set_ - in.velocity;
    double demand = p.speed_gain * speed_error + integral_ + p.acceleration_feedforward * in.acceleration;
    if (p.damping_gain != 0) demand += p.damping_gain * in.load_velocity;
    if (p.friction_compensation != 0) {
      constexpr double steep = 0.1;  // mm/s or deg/s of the command: the compensation is whole beyond it
      demand += p.friction_compensation * p.rated_torque * std::clamp(in.velocity_set / steep, -1.0, 1.0);
    }
    if (in.torque_excitation != 0) demand += in.torque_excitation;
    const double unfiltered = demand;
    if (p.notch.on) demand = notch(p.notch, demand);
    if (p.torque_filter_time > 0) {
      filtered_ += (demand - filtered_) * std::min(1.0, h / p.torque_filter_time);
      demand = filtered_;
    }
    const double limited = std::clamp(demand, -p.peak_torque, p.peak_torque);
    const bool free =
        p.notch.on || p.torque_filter_time > 0 ? std::abs(unfiltered) < p.peak_torque : demand == limited;
    // The integrator stops while the torque is at its limit, so that it does not wind up.
    if (p.speed_integral_time > 0 && free)
      integral_ += p.speed_gain / p.speed_integral_time * speed_error * h;
    torque_ += (limited - torque_) * std::min(1.0, h / p.current_time_constant);
    return torque_;
  }
  /// One step of `h` s in torque follow: the current loop alone, with `demand`.
  double follow(const ServoParameters& p, double demand, double h) {
    const double limited = std::clamp(demand, -p.peak_torque, p.peak_torque);
    torque_ += (limited - torque_) * std::min(1.0, h / p.current_time_constant);
    integral_ = torque_;  // the loops continue from it
    return torque_;
  }
  double torque() const { return torque_; }
  /// Setpoint of the speed loop in the newest step, the excitation included.
  double speed_set() const { return speed_set_; }

  /// No field, step() sets it: speed_set_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("torque", self.torque_);
    visit("integral", self.integral_);
    // Written where there is something: recordings of drives without filters have no such state.
    if (!std::is_const_v<Self> || self.filtered_ != 0 || self.notch_1_ != 0 || self.notch_2_ != 0) {
      visit("filtered", self.filtered_);
      visit("notch_1", self.notch_1_), visit("notch_2", self.notch_2_);
    }
  }

 private:
  // Transposed direct form 2.
  double notch(const NotchFilter& n, double in) {
    const double out = n.b0 * in + notch_1_;
    notch_1_ = n.b1 * in - n.a1 * out + notch_2_;
    notch_2_ = n.b2 * in - n.a2 * out;
    return out;
  }

  double torque_ = 0, integral_ = 0, speed_set_ = 0, filtered_ = 0, notch_1_ = 0, notch_2_ = 0;
};

}  // namespace trunnion::drive
