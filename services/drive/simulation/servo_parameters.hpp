// SPDX-License-Identifier: Apache-2.0
// Settings of a servo drive and its axis. Everything is in units of the load: mm or deg, and torque as the
// acceleration it gives the nominal inertia.
#pragma once

#include "machine/parameters.hpp"

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

}  // namespace trunnion::drive
