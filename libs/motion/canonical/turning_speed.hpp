// SPDX-License-Identifier: Apache-2.0
// The speed of a spindle with constant surface speed (G96).
#pragma once

#include <algorithm>
#include <numbers>

namespace trunnion::canonical {

/// m/min are 1000 mm/min.
inline constexpr double millimetres_of_metre = 1000;

/// 1/min at which a surface `radius` mm from the centre of the spindle has `speed` m/min, at most `limit`
/// 1/min: at the centre it is the limit. None is below 0; 0 without a speed.
inline double turning_speed(double speed, double radius, double limit) {
  if (!(speed > 0)) return 0;
  const double circumference = 2 * std::numbers::pi * radius, way = millimetres_of_metre * speed;
  return way >= limit * circumference ? limit : way / circumference;
}

/// mm: nearer to the centre the spindle has its limit, 1/min above 0.
inline double radius_of_limit(double speed, double limit) {
  return millimetres_of_metre * speed / (2 * std::numbers::pi * limit);
}

/// The lower one of two limits, 1/min; 0 = none.
inline double lower_limit(double one, double other) {
  if (!(one > 0)) return other;
  return other > 0 ? std::min(one, other) : one;
}

}  // namespace trunnion::canonical
