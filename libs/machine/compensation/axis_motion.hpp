// SPDX-License-Identifier: Apache-2.0
// The direction in which an axis moved last.
#pragma once

#include <cmath>

namespace trunnion::compensation {

struct AxisMotion {
  double last = 0;       ///< mm or deg: newest setpoint that counted as a move, without compensation
  double direction = 0;  ///< -1, 1, or 0 before the first move

  /// The rounding of a transformation is no reversal: what depends on the direction must not change by it.
  static constexpr double rounding = 1e-9;  // mm or deg

  /// True when the axis turns round.
  bool follow(double x) {
    if (!(std::abs(x - last) > rounding)) return false;
    const double before = direction;
    direction = x > last ? 1 : -1;
    last = x;
    return before != 0 && before != direction;
  }
};

}  // namespace trunnion::compensation
