// What the axes and the path tolerate.
#pragma once

#include <array>

#include "language/canonical.hpp"

namespace trunnion::motion {

using language::AxisValues;

/// Limits of one machine axis. Units per axis: mm or degrees, seconds. All above zero.
struct AxisLimits {
  double velocity = 100;        ///< at feed, unit/s
  double rapid_velocity = 100;  ///< at rapid, unit/s
  double acceleration = 1000;   ///< unit/s^2, sum of the tangential and the normal part
  double jerk = 60000;          ///< unit/s^3
};

/// Limits of a trajectory. The tolerances bound how far the smoothed path may leave the programmed one.
struct Limits {
  std::array<AxisLimits, language::axis_count> axes{};
  /// An acceleration takes at least this many cycles to build up: jerk stays below acceleration / (N dt).
  int smoothing_cycles = 1;             ///< 1..64
  double contour_tolerance = 0.01;      ///< mm at corners and along short segments; 0: exact
  double arc_tolerance = 0.005;         ///< mm where arcs join other segments
  double orientation_tolerance = 0.05;  ///< degrees of the rotary axes together
  double smooth_corner_angle = 180;     ///< degrees; motion stops where the direction turns by more
  double centripetal_acceleration = 0;  ///< mm/s^2 of the tool tip in curves; 0: the axes alone
};

inline constexpr int max_smoothing_cycles = 64;

}  // namespace trunnion::motion
