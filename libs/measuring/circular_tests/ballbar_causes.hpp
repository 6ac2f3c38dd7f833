// SPDX-License-Identifier: Apache-2.0
// What the radial deviations of a ballbar say about the machine. docs/circular-tests.md has the closed forms.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "circular_tests/circular_figures.hpp"

namespace trunnion::circular_tests {

/// deg: readings nearer to a reversal do not count in the fit of the causes. There an axis is still crossing
/// its lost motion.
inline constexpr double reversal_zone = 3;
/// deg behind a reversal in which its spike is looked for.
inline constexpr double spike_zone = 10;

struct BallbarCauses {
  double centre_first = 0, centre_second = 0;  ///< mm: centre of the circle less the programmed centre
  double radius = 0;                           ///< mm: mean deviation of the radius
  double squareness = 0;      ///< rad: above zero when the angle of the axes exceeds 90 degrees
  double scale_mismatch = 0;  ///< relative error of the first axis less that of the second
  double reversal_first = 0, reversal_second = 0;  ///< lost motion, mm: above zero where the axis lags
  double lag_mismatch = 0;  ///< mm: speed times (1 / Kv of the first axis less 1 / Kv of the second)
  /// Reversal spikes at 0, 90, 180, 270 deg, mm, positive outwards: the farthest deviation from the causes
  /// above within the reversal and `spike_zone` behind it, beyond the lost motion. At 0 and 180 deg the first
  /// axis reverses.
  std::array<double, 4> spike_ccw{}, spike_cw{};
  double rest = 0;  ///< mm: root mean square of what the causes above do not explain
};

/// Least squares over both paths, each with evenly distributed readings (at least eight). The servo's lag
/// must be small against the radius (mm).
BallbarCauses ballbar_causes(Readings ccw, Readings cw, double radius);

/// What a cause alone would make of the circle.
struct CauseShare {
  std::string name;  ///< "squareness", "scale mismatch", "lost motion 1", "spike 2" ...
  double span = 0;   ///< mm: largest less least radial deviation by it
  double share = 0;  ///< of the sum of all spans, 0 .. 1
};
/// The centre and the radius are the setting of the instrument and have no share. In descending order.
std::vector<CauseShare> cause_shares(const BallbarCauses& causes, double radius);

}  // namespace trunnion::circular_tests
