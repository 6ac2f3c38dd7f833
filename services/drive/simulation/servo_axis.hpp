// SPDX-License-Identifier: Apache-2.0
// One servo axis: position P, speed PI, current lag, motor and load inertia, friction, limits, encoder.
// Everything is in units of the load: mm or deg, and torque as the acceleration it gives the nominal inertia.
#pragma once

#include "drive_hardware.hpp"

namespace trunnion::drive {

struct ServoParameters {
  double position_gain = 60;              ///< 1/s
  double speed_gain = 600;                ///< 1/s, for the nominal inertia
  double speed_integral_time = 0.012;     ///< s, 0 = off
  double current_time_constant = 0.0004;  ///< s
  double velocity_feedforward = 1, acceleration_feedforward = 1;
  double inertia = 1;         ///< total inertia over the nominal one (motor and an equal load)
  double peak_torque = 9000;  ///< acceleration of the nominal inertia, mm/s2 or deg/s2
  double rated_torque = 4500;
  double coulomb = 0, viscous = 0;  ///< shares of the rated torque; viscous at rapid traverse
  double rapid = 400;               ///< mm/s or deg/s
  double resolution = 1e-5;         ///< of the encoder, mm or deg
  double backlash = 0;              ///< lost motion of the mechanics, mm or deg

  static ServoParameters from(const machine::Parameters& parameters, std::uint32_t axis);
};

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

  double encoder() const { return encoder_; }                  ///< quantized motor position, mm or deg
  double load() const { return load_; }                        ///< true position behind the backlash
  double velocity() const { return velocity_; }                ///< mm/s or deg/s
  double torque() const { return torque_ / p_.rated_torque; }  ///< share of the rated torque
  double command() const { return command_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("command", self.command_);
    visit("position", self.position_);
    visit("velocity", self.velocity_);
    visit("torque", self.torque_);
    visit("integral", self.integral_);
    visit("encoder", self.encoder_);
    visit("load", self.load_);
  }

 private:
  static constexpr int substeps = 8;
  ServoParameters p_;
  double command_ = 0, position_ = 0, velocity_ = 0, torque_ = 0, integral_ = 0;
  double encoder_ = 0, load_ = 0;
};

}  // namespace trunnion::drive
