// SPDX-License-Identifier: Apache-2.0
// The mechanics and the encoders of one servo axis as they are: the section `drives` of truth.yaml.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "truth/true_geometry.hpp"

namespace trunnion::truth {

/// Motor and load with an elastic coupling between them. Torques are shares of the motor's rated torque;
/// positions and speeds are those of the load, mm or deg. Frequencies follow from the share of the load in
/// the total inertia.
struct MechanicsTruth {
  double load_share = 0.5;        ///< of the total inertia, 0.02 .. 0.98
  double locked_frequency = 100;  ///< Hz: of the load while the motor is held
  double damping_ratio = 0.03;    ///< of that vibration
  /// Friction of the load's guide: coulomb + (breakaway - coulomb) / (1 + (v / stribeck_speed)^2) + viscous *
  /// |v|.
  double coulomb = 0, breakaway = 0;
  double stribeck_speed = 1;                      ///< mm/s or deg/s
  double viscous = 0;                             ///< per mm/s or deg/s
  double backlash = 0;                            ///< mm or deg
  double gravity = 0;                             ///< pulls the load in the negative direction
  double cogging = 0;                             ///< amplitude
  double cogging_period = 10, cogging_phase = 0;  ///< mm or deg of the axis; deg
  ErrorFunction screw;  ///< by the motor's position: how far the load is ahead of it, mm or deg
};

enum class EncoderKind : std::uint8_t {
  absolute,        ///< has its position from the start
  incremental,     ///< counts from its start, with an index at regular positions
  distance_coded,  ///< counts from its start; the distance of two neighbouring marks gives their place
};

/// One encoder. mm or deg of the axis.
struct EncoderTruth {
  EncoderKind kind = EncoderKind::absolute;
  double resolution = 1e-5;
  bool inverted = false;     ///< mounted the wrong way round
  double signal_period = 0;  ///< of a 1 Vpp signal; 0: digital, without an interpolation error
  double amplitude = 0;      ///< of the sine over the cosine, less one
  double sine_offset = 0, cosine_offset = 0;  ///< shares of the amplitude
  double phase = 0;                           ///< deg: of the sine ahead of its right place
  double mark_spacing = 20;      ///< of the index marks; of distance-coded marks: of those of the first track
  double mark_increment = 0.02;  ///< distance-coded: by which the gaps change
  double first_mark = 0;         ///< of distance-coded marks below the travel
  double lost_at = 0;            ///< a damaged place, where pulses are missing at every passage
  std::int32_t lost_counts = 0;  ///< as many, of `resolution`
};

/// Alarms of a drive. At the first three it cannot control its motor any longer: emergency alarms.
enum class DriveFaultKind : std::uint8_t {
  power_module,
  overcurrent,
  overvoltage,
  following_error,
  overspeed,
  overload,
  locked_rotor,
  bus
};
inline bool is_emergency(DriveFaultKind kind) { return kind <= DriveFaultKind::overvoltage; }

/// For tests: the drive reports an alarm when its load passes a position.
struct DriveFaultTruth {
  DriveFaultKind kind = DriveFaultKind::overload;
  double at = 0;  ///< mm or deg
};

/// How a spindle differs from an ideal one. The torque of its motor: up to its speed 0 the first one, beyond
/// the last speed the last one of the curve; in between it is linear.
struct SpindleTruth {
  struct Point {
    double speed = 0;   ///< 1/min
    double torque = 0;  ///< Nm
  };
  double inertia = 0;            ///< kg m2, all that turns, at the spindle
  std::vector<Point> torque{};   ///< by speed, rising; empty: a spindle that is always strong enough
  double speed_error = 0;        ///< share of the commanded speed by which the true one is greater
  double ripple = 0;             ///< amplitude of a sinusoidal disturbance of the speed, share of it
  double ripple_frequency = 1;   ///< Hz
  double load_torque = 0;        ///< Nm, against the rotation
  std::vector<double> gears{};   ///< revolutions of the motor for one of the spindle, by gear from 1
  std::optional<double> mark{};  ///< deg, clockwise from where it starts; nothing: it starts there, homed
  bool has_motor() const { return !torque.empty(); }
  /// Nm at the spindle at its `speed` (1/min, of either sign) in a gear (from 1; one that `gears` does not
  /// have turns it once for a revolution of the motor). Only with a motor.
  double torque_at(double speed, std::size_t gear = 0) const;
};

struct DriveTruth {
  std::optional<MechanicsTruth> mechanics;
  EncoderTruth motor;
  std::optional<EncoderTruth> load;
  std::optional<DriveFaultTruth> fault;
};

}  // namespace trunnion::truth
