// SPDX-License-Identifier: Apache-2.0
// The types that every kinematic function uses.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>

namespace trunnion::geometry {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

inline constexpr std::size_t angle_count = 6;

/// Positions of the axes A B C U V W of a channel in degrees, as they are programmed. Entries that no rotary
/// axis names are ignored: U V W are mostly linear.
using Angles = std::array<double, angle_count>;

/// The angles of a row X Y Z A B C U V W.
inline Angles angles_of(const double* row) {
  Angles angles;
  std::copy_n(row + 3, angle_count, angles.begin());
  return angles;
}

}  // namespace trunnion::geometry
