// SPDX-License-Identifier: Apache-2.0
// How a corner or a jump of curvature is rounded: a function of the path length that is added to the path.
//
// A path whose direction jumps by D at 0 becomes twice continuously differentiable when
//   D (w - |x|)^3 / (6 w^2)
// is added within the reach w: its slope jumps by -D, its second derivative is D (w - |x|) / w^2 (nothing at
// +-w), its third D / w^2. It is the path averaged with a triangular window of half width w. A jump C of the
// second derivative is removed by the odd function with g'' = -C/2 sign(x) (1 - 3y + 2y^2), y = |x| / w,
// whose slope and value vanish at +-w as well.
#pragma once

#include <array>
#include <cmath>

namespace trunnion::motion {

/// Value and first three derivatives.
using BlendTerms = std::array<double, 4>;

/// For a jump of direction of 1, `x` from it; the third derivative is that of the side `side` (-1 or 1).
inline BlendTerms direction_blend(double x, double side, double reach) {
  const double rest = reach - std::abs(x);
  const double area = reach * reach;
  return {rest * rest * rest / (6 * area), -side * rest * rest / (2 * area), rest / area, -side / area};
}

/// For a jump of the second derivative of 1.
inline BlendTerms curvature_blend(double x, double side, double reach) {
  const double y = std::abs(x) / reach;
  return {side * reach * reach * y * (1.0 / 12 - y * (1.0 / 4 - y * (1.0 / 4 - y / 12))),
          reach * (1.0 / 12 - y * (0.5 - y * (0.75 - y / 3))), -0.5 * side * (1 - y * (3 - 2 * y)),
          (1.5 - 2 * y) / reach};
}

/// Largest value of curvature_blend for a reach of 1, at y = 1/4.
inline constexpr double curvature_blend_height = 0.0088;

}  // namespace trunnion::motion
