// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "canonical/canonical.hpp"

namespace trunnion::motion {

/// Once around 0 in chords of about `chord`, coordinates rounded to multiples of `grain`, all in mm.
inline std::vector<canonical::AxisValues> circle_points(double radius, double chord, double grain) {
  const int count = static_cast<int>(std::round(2 * std::numbers::pi * radius / chord));
  std::vector<canonical::AxisValues> points;
  for (int k = 0; k <= count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    points.push_back({std::round(radius * std::cos(angle) / grain) * grain,
                      std::round(radius * std::sin(angle) / grain) * grain});
  }
  return points;
}

}  // namespace trunnion::motion
