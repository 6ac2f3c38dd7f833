// SPDX-License-Identifier: Apache-2.0
// Rotations of tilted planes and of workpieces.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "language/canonical.hpp"

namespace trunnion::language {

using Matrix3 = std::array<double, 9>;  ///< rows
inline constexpr Matrix3 no_rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};

inline Matrix3 multiplied(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      for (std::size_t k = 0; k < 3; ++k) c[3 * row + column] += a[3 * row + k] * b[3 * k + column];
    }
  }
  return c;
}

/// Right-handed rotation about X, Y or Z (0, 1, 2).
inline Matrix3 rotation(std::size_t axis, double degrees) {
  const double angle = std::remainder(degrees, 360.0) * (std::numbers::pi / 180.0);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  if (axis == 0) return {1, 0, 0, 0, c, -s, 0, s, c};
  if (axis == 1) return {c, 0, s, 0, 1, 0, -s, 0, c};
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

/// Rotation by degrees about X, then Y, then Z, axes that stay where they are.
inline Matrix3 roll_pitch_yaw(double x, double y, double z) {
  return multiplied(multiplied(rotation(2, z), rotation(1, y)), rotation(0, x));
}

inline Vector3 turned(const Matrix3& m, const Vector3& d) {
  return {m[0] * d[0] + m[1] * d[1] + m[2] * d[2], m[3] * d[0] + m[4] * d[1] + m[5] * d[2],
          m[6] * d[0] + m[7] * d[1] + m[8] * d[2]};
}

/// The inverse of turned().
inline Vector3 turned_back(const Matrix3& m, const Vector3& d) {
  return {m[0] * d[0] + m[3] * d[1] + m[6] * d[2], m[1] * d[0] + m[4] * d[1] + m[7] * d[2],
          m[2] * d[0] + m[5] * d[1] + m[8] * d[2]};
}

}  // namespace trunnion::language
