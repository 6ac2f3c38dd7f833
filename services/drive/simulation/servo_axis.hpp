// SPDX-License-Identifier: Apache-2.0
// One servo axis: position P, speed PI, current lag, motor and load inertia, friction, limits, encoder.
// Everything is in units of the load: mm or deg, and torque as the acceleration it gives the nominal inertia.
#pragma once

#include "drive_hardware.hpp"
#include "servo_loop.hpp"

namespace trunnion::drive {

class ServoAxis {
 public:
  void configure(const ServoParameters& parameters) { p_ = parameters; }
  /// Is at rest at `position`, as an absolute encoder finds it.
  void place(double position);
  /// One period of `dt` seconds: the command moves from where it was to the position of `setpoint`, with its
  /// acceleration.
  void step(const AxisSetpoint& setpoint, double dt);
  /// Drives off: the brake holds the axis where it is.
  void hold();

  double encoder() const { return encoder_; }                         ///< quantized motor position, mm or deg
  double load() const { return load_; }                               ///< true position behind the backlash
  double velocity() const { return velocity_; }                       ///< mm/s or deg/s
  double torque() const { return loop_.torque() / p_.rated_torque; }  ///< share of the rated torque
  double command() const { return command_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("command", self.command_);
    visit("position", self.position_);
    visit("velocity", self.velocity_);
    ServoLoop::fields(self.loop_, visit);
    visit("encoder", self.encoder_);
    visit("load", self.load_);
  }

 private:
  static constexpr int substeps = 8;
  ServoParameters p_;
  ServoLoop loop_;
  double command_ = 0, position_ = 0, velocity_ = 0;
  double encoder_ = 0, load_ = 0;
};

}  // namespace trunnion::drive
