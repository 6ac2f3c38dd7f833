// SPDX-License-Identifier: Apache-2.0
// What two rotary axes can do to the tool direction.
#pragma once

#include <optional>

#include "geometry/types.hpp"

namespace trunnion::geometry {

/// Two axes that turn a tool: first about k2, then both about k1. On the unit sphere k1, k2 and the turned
/// tool are a triangle with the sides alpha (k1 k2), beta (k2 tool) and psi (k1 tool); its angle at k2 is x.
struct AxisPair {
  Vec3 k1 = Vec3::UnitZ(), k2 = Vec3::UnitX();
  Vec3 f = Vec3::UnitZ(), g = Vec3::UnitX();  ///< with k2 a right-handed frame; k1 lies in the plane of k2, f
  double alpha = 0, beta = 0;                 ///< rad
  double sine_beta = 0, cosine_beta = 1;
  double sine_half_sum = 0, cosine_half_sum = 1;                ///< of (alpha + beta) / 2
  double sine_half_difference = 0, cosine_half_difference = 1;  ///< of (alpha - beta) / 2
  double zero = 0;  ///< angle of the tool about k2 when axis 2 is at zero, counted from f, rad

  /// Nothing when the axes are parallel, or axis 2 turns about the tool itself.
  static std::optional<AxisPair> make(const Vec3& k1, const Vec3& k2, const Vec3& tool);

  struct Triangle {
    double x = 0;  ///< 0 .. pi
    double sine_x = 0, cosine_x = 1;
    double regularity = 0;  ///< sine alpha * sine beta * sine x
    bool two = false;       ///< x and -x are different positions
    double missed = 0;      ///< rad from u to what the pair reaches
  };
  /// The triangle of the unit vector u = turned tool, or the nearest there is. Loses no digits near poles and
  /// borders. `across` is k1 x u.
  Triangle triangle(const Vec3& u, const Vec3& across) const;

  /// The tool turned about k2 to x (side 1) or -x (side -1).
  Vec3 tool_at(const Triangle& triangle, double side) const;

  /// Position of axis 2 in degrees for that.
  double second(const Triangle& triangle, double side) const;

  /// The tool with both axes at these positions, degrees.
  Vec3 direction(double first, double second) const;

  /// First three derivatives of the positions of axes 1 and 2 (degrees) along a path of directions, given the
  /// direction and its derivatives and the position of axis 1. At a pole axis 1 rests and axis 2
  /// follows what it can.
  std::array<std::array<double, 2>, 3> derivatives(const std::array<Vec3, 4>& u, double first) const;
};

}  // namespace trunnion::geometry
