// SPDX-License-Identifier: Apache-2.0
// The motion of a circular test.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/types.hpp"

namespace trunnion::circular_tests {

/// Which of X Y Z the axes of a plane are.
struct CirclePlane {
  std::size_t first = 0, second = 1;
};
/// Of XY, XZ or YZ.
CirclePlane plane_of(const std::string& name);

struct CircleMotion {
  std::string plane = "XY";                        ///< XY, XZ or YZ
  geometry::Vec3 centre = geometry::Vec3::Zero();  ///< mm, machine coordinates
  double radius = 100;                             ///< mm
  double feed = 1000;                              ///< mm/min
  double start = 0;                                ///< deg, where the reading begins
  double overrun = 45;                             ///< deg, before and behind the reading
};

/// Radially to the circle, a turn and the overruns at both ends, back to the centre; both senses. `after`:
/// the linear axes and where they go at the end, mm.
std::string circle_program(const CircleMotion& motion, const std::vector<std::pair<char, double>>& after);

}  // namespace trunnion::circular_tests
