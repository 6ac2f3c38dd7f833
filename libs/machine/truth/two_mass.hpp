// SPDX-License-Identifier: Apache-2.0
// The motion of two masses, motor and load, with spring, backlash and friction.
#pragma once

#include "truth/drive_truth.hpp"

namespace trunnion::truth {

/// Friction of the guide as a share of the rated torque, of the sign of `speed`. The fall from breakaway to
/// Coulomb friction is the rational one of Hess and Soom (1990), which needs no exponential function.
double friction(const MechanicsTruth& mechanics, double speed);

class TwoMass {
 public:
  /// `inertia`: total, over the nominal one that the torque's unit refers to; `rated_torque`: acceleration it
  /// gives the nominal inertia, mm/s2 or deg/s2.
  void configure(const MechanicsTruth& mechanics, double inertia, double rated_torque);
  /// At rest, the motor at `motor`, the load where the spring carries its weight.
  void place(double motor);
  /// Advances by `dt` s with `torque` of the motor as the acceleration of the nominal inertia. Symplectic: a
  /// vibration of w rad/s keeps its energy, and its frequency is off by (w dt)^2 / 24; stable for w dt < 2.
  /// `load_force` acts on the load from outside, in the unit of the torque.
  void step(double torque, double dt, double load_force = 0);
  /// The brake of the motor acts.
  void stop() { motor_speed_ = load_speed_ = 0; }

  double motor() const { return motor_; }
  double load() const { return load_; }
  double motor_speed() const { return motor_speed_; }
  double load_speed() const { return load_speed_; }
  /// Torque of the motor that holds the weight, in the unit of step().
  double holding_torque() const { return mechanics_.gravity * rated_torque_; }

  /// No fields, configure() sets them: mechanics_, motor_mass_, load_mass_, stiffness_, damping_,
  /// rated_torque_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("motor", self.motor_), visit("load", self.load_);
    visit("motor_speed", self.motor_speed_), visit("load_speed", self.load_speed_);
  }

 private:
  double cogging() const;

  MechanicsTruth mechanics_;
  double motor_mass_ = 0.5, load_mass_ = 0.5, stiffness_ = 1, damping_ = 0, rated_torque_ = 1;
  double motor_ = 0, load_ = 0, motor_speed_ = 0, load_speed_ = 0;
};

}  // namespace trunnion::truth
