// SPDX-License-Identifier: Apache-2.0
// A piece of a smooth curve of all axes.
#pragma once

#include <array>

#include "canonical/canonical.hpp"

namespace trunnion::motion {

using canonical::AxisValues;

/// Position and its first three derivatives divided by 1, 2 and 6: c0 + s (c1 + s (c2 + s c3)).
using Cubic = std::array<AxisValues, 4>;

/// Bound of the distance between a curve and a line over the same `length`, linear and rotary axes apart: the
/// difference is a cubic, and a cubic lies within the hull of its Bezier points.
struct CurveDeviation {
  double linear = 0, rotary = 0;
};
CurveDeviation deviation_bound(const Cubic& curve, const AxisValues& start, const AxisValues& slope,
                               double length);

/// `curve` with its origin moved on by `t`.
Cubic shifted(const Cubic& curve, double t);

}  // namespace trunnion::motion
