// SPDX-License-Identifier: Apache-2.0
// Circular deviations by ISO 230-4:2005 of a circle that was run counter-clockwise and clockwise.
#pragma once

#include <span>
#include <vector>

#include "geometry/radial_reading.hpp"

namespace trunnion::circular_tests {

using geometry::RadialReading;
using Readings = std::span<const RadialReading>;

/// A circle in the place of the programmed one, and how far the points are from it.
struct ReferenceCircle {
  double first = 0, second = 0;   ///< mm: its centre less the programmed centre, along both axes
  double radius = 0;              ///< mm: its radius less the programmed radius
  double least = 0, largest = 0;  ///< mm: radial distances of the points from it, positive outside
  double span() const { return largest - least; }
};

/// Least squares of the radial distances (Gauss-Newton from the programmed circle; the deviations are small
/// against `radius`, mm). At least three readings that are not all at one side.
ReferenceCircle least_squares_circle(Readings readings, double radius);

/// The pair of concentric circles with the least radial separation that enclose all readings; its mean is the
/// reference circle. Nested golden section about the least-squares centre: the separation is a convex
/// function of the centre but for terms of (deviation)^2 / radius.
ReferenceCircle minimum_zone_circle(Readings readings, double radius);

/// Figures of ISO 230-4:2005, 3.4 to 3.8, mm. G is defined by the minimum zone; the standard permits the
/// range about the least-squares circle instead, which is never smaller. F refers to the programmed centre
/// and radius.
struct CircularFigures {
  double deviation_ccw = 0, deviation_cw = 0;                ///< circular deviation G
  double bidirectional = 0;                                  ///< G(b), both paths in one zone
  double squares_ccw = 0, squares_cw = 0, squares_both = 0;  ///< the same about the least-squares circle
  double hysteresis = 0;        ///< H: largest radial difference of the paths at one angle
  double hysteresis_angle = 0;  ///< deg: where
  double radial_least_ccw = 0, radial_largest_ccw = 0, radial_least_cw = 0, radial_largest_cw = 0;  ///< F
  double mean_radial = 0;  ///< D: radius of the least-squares circle of both paths less the programmed one
  ReferenceCircle fitted;  ///< least squares of both paths
};

/// Either path may be empty: its figures, G(b) and H are 0 then. Otherwise a path needs at least eight
/// readings over a whole turn, in the order of the motion. Throws std::invalid_argument.
CircularFigures circular_figures(Readings ccw, Readings cw, double radius);

}  // namespace trunnion::circular_tests
