// SPDX-License-Identifier: Apache-2.0
// Settings of a servo drive and its axis. Everything is in units of the load: mm or deg, and torque as the
// acceleration it gives the nominal inertia.
#pragma once

#include "machine/parameters.hpp"

namespace trunnion::drive {

/// Periods of the speed loop in one interpolation cycle.
inline constexpr int servo_substeps = 8;

/// Notch filter (s^2 + w^2) / (s^2 + B s + w^2), bilinear, exact at the centre w.
struct NotchFilter {
  bool on = false;
  double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
  /// `frequency` and `width` Hz, `h` s; off where the frequency is 0 or not below half the sampling rate.
  static NotchFilter at(double frequency, double width, double h);
};

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

  double torque_filter_time = 0;     ///< s, 0 = off
  NotchFilter notch;                 ///< of the torque command
  double friction_compensation = 0;  ///< share of the rated torque
  double damping_gain = 0;           ///< 1/s: torque per difference of speed between load and motor

  bool full_closed_loop = false;        ///< position loop over the load encoder
  double load_sign = 1;                 ///< of the load encoder
  double load_pulses = 0;               ///< of the load encoder per revolution of the motor; 0: no conversion
  double travel_per_revolution = 10;    ///< mm or deg, above 0
  double dual_loop_time = 0;            ///< s
  double encoder_difference_limit = 0;  ///< mm or deg, 0 = off

  static ServoParameters from(const machine::Parameters& parameters, std::uint32_t axis);
};

}  // namespace trunnion::drive
