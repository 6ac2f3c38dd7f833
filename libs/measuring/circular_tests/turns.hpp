// SPDX-License-Identifier: Apache-2.0
// Whole turns of a circle within a recorded motion.
#pragma once

#include <vector>

#include "circular_tests/circular_figures.hpp"

namespace trunnion::circular_tests {

struct PlanePoint {
  double first = 0, second = 0;  ///< mm, along both axes of the plane
};

/// A circle as it was programmed, in the coordinates of the points.
struct ProgrammedCircle {
  PlanePoint centre;
  double radius = 100;  ///< mm
};

/// Samples begin .. end - 1 are one turn; what was moved before and behind it on the circle is left out.
struct Turn {
  std::size_t begin = 0, end = 0;
  int sense = 1;       ///< 1 counter-clockwise, -1 clockwise
  double start = 0;    ///< deg: commanded angle at `begin`, 0 .. 360
  double overrun = 0;  ///< deg: that was left out at each end
};

/// The stretches of `commanded` on the circle (within a hundredth of the radius) that turn in one sense by
/// 360 degrees at least; of each the middle turn, as the standard wants the same run-in and run-out.
std::vector<Turn> turns_on(const std::vector<PlanePoint>& commanded, const ProgrammedCircle& circle);

/// The circle that `commanded` turns on by 360 degrees first: three points fifty samples apart and the points
/// between and behind them must be on it within `tolerance` mm. Throws std::runtime_error when there is none.
ProgrammedCircle find_circle(const std::vector<PlanePoint>& commanded, double tolerance);

/// The turn of `actual` in polar coordinates about the programmed centre.
std::vector<RadialReading> readings_of(const std::vector<PlanePoint>& actual, const Turn& turn,
                                       const ProgrammedCircle& circle);

/// The mean speed along `commanded` in the turn, mm/min; `interval` s between two points.
double feed_reached(const std::vector<PlanePoint>& commanded, const Turn& turn, double interval);

}  // namespace trunnion::circular_tests
