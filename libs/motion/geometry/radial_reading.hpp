// SPDX-License-Identifier: Apache-2.0
// A point of a measured circle.
#pragma once

namespace trunnion::geometry {

/// One point of an actual path, in polar coordinates about the programmed centre. Angles are counted from the
/// first axis of the plane to the second.
struct RadialReading {
  double angle = 0;      ///< deg
  double deviation = 0;  ///< mm: distance from the programmed centre less the programmed radius
};

}  // namespace trunnion::geometry
