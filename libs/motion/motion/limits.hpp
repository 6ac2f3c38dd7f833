// SPDX-License-Identifier: Apache-2.0
// The limits of the axes and the tolerances of the path.
#pragma once

#include <array>

#include "canonical/canonical.hpp"

namespace trunnion::motion {

using canonical::AxisValues;

/// Limits of one machine axis. Units per axis: mm or degrees, seconds. All above zero.
struct AxisLimits {
  double velocity = 100;        ///< at feed, unit/s
  double rapid_velocity = 100;  ///< at rapid, unit/s
  double acceleration = 1000;   ///< unit/s^2, sum of the tangential and the normal part
  double jerk = 60000;          ///< unit/s^3
};

/// What a machining mode requires of the path. The tolerances bound the distance of the smoothed path from
/// the programmed one.
struct PathMode {
  /// An acceleration takes at least this many cycles to build up: jerk stays below acceleration / (N dt).
  int smoothing_cycles = 1;             ///< 1..64
  double contour_tolerance = 0.01;      ///< mm at corners and along short segments; 0: exact
  double orientation_tolerance = 0.05;  ///< degrees of the rotary axes together
  double smooth_corner_angle = 180;     ///< degrees; motion stops where the direction turns by more
  double centripetal_acceleration = 0;  ///< mm/s^2 of the tool tip in curves; 0: the axes alone
};

/// Limits of a trajectory. Its own PathMode is that of G5.1 Q0.
struct Limits : PathMode {
  std::array<AxisLimits, canonical::axis_count> axes{};
  bool combined_feed = true;        ///< F counts mm and degrees together where no transformation is active
  double arc_tolerance = 0.005;     ///< mm by which the pieces of a curve and what joins them may leave it
  std::array<PathMode, 2> modes{};  ///< of G5.1 Q1 and Q2
};

/// The limits in each machining mode, with the jerk its smoothing cycles leave of the axes'.
inline constexpr std::size_t path_modes = 3;
using ModeLimits = std::array<Limits, path_modes>;

inline constexpr int max_smoothing_cycles = 64;

}  // namespace trunnion::motion
