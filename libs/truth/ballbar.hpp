// SPDX-License-Identifier: Apache-2.0
// The circular test of ISO 230-4 with a ballbar: two circles, counter-clockwise and clockwise, and what their
// radial deviations say.
#pragma once

#include <span>
#include <vector>

#include "truth/true_geometry.hpp"

namespace trunnion::truth {

/// Angles are counted from the first axis of the plane to the second.
struct BallbarPath {
  Vec3 centre = Vec3::Zero();         ///< mm, tip in the frame of the workpiece
  std::size_t first = 0, second = 1;  ///< linear axes of the plane: 0 1 = XY, 0 2 = XZ, 1 2 = YZ
  double radius = 100;                ///< mm
  std::size_t points = 720;           ///< of each circle
};

struct BallbarReading {
  double angle = 0;      ///< deg
  double deviation = 0;  ///< mm: length of the ballbar less the radius
};

/// Length of the ballbar between its socket at the centre and the tip, less the nominal radius, mm.
double ballbar_deviation(const BallbarPath& path, const Vec3& tip);

struct BallbarResult {
  double circular_ccw = 0,
         circular_cw = 0;    ///< circular deviation G of ISO 230-4 about the fitted circle, mm
  double bidirectional = 0;  ///< G(b), both circles together, mm
  double radial_minimum = 0, radial_maximum = 0;  ///< radial deviation F about the nominal circle, mm
  Vec3 centre = Vec3::Zero();  ///< of the fitted circle, less the nominal centre; in the plane, mm
  double radius = 0;           ///< mean deviation of the radius, mm
  double squareness = 0;       ///< rad: above zero when the angle of the axes exceeds 90 degrees
  double scale_mismatch = 0;   ///< relative error of the first axis less that of the second
  double reversal_first = 0, reversal_second = 0;  ///< lost motion, mm: above zero where the axis lags
  double lag_mismatch = 0;  ///< mm: speed times (1 / Kv of the first axis less 1 / Kv of the second)
};

/// Least squares over both circles of the closed forms in docs/truth.md. The circles have evenly distributed
/// points, at least eight. The servo's lag must be small against the radius.
BallbarResult evaluate_ballbar(const BallbarPath& path, std::span<const BallbarReading> ccw,
                               std::span<const BallbarReading> cw);

}  // namespace trunnion::truth
