// SPDX-License-Identifier: Apache-2.0
// The circular test of ISO 230-4 with a ballbar: two circles, counter-clockwise and clockwise.
#pragma once

#include "truth/true_geometry.hpp"

namespace trunnion::truth {

/// Angles are counted from the first axis of the plane to the second.
struct BallbarPath {
  Vec3 centre = Vec3::Zero();         ///< mm, tip in the frame of the workpiece
  std::size_t first = 0, second = 1;  ///< linear axes of the plane: 0 1 = XY, 0 2 = XZ, 1 2 = YZ
  double radius = 100;                ///< mm
  std::size_t points = 720;           ///< of each circle
};

/// Length of the ballbar between its socket at the centre and the tip, less the nominal radius, mm.
inline double ballbar_deviation(const BallbarPath& path, const Vec3& tip) {
  return (tip - path.centre).norm() - path.radius;
}

}  // namespace trunnion::truth
