// SPDX-License-Identifier: Apache-2.0
// Location errors of one rotary axis from a ball that the control holds in its place while the axis turns.
#pragma once

#include <span>

#include "identification/geometry_fit.hpp"

namespace trunnion::identification {

struct BallDeviation {
  geometry::Angles angles{};  ///< deg, A B C U V W as commanded
  /// mm: of the tip from the ball, as positions of X, Y and Z: machine_from_tip(true tip) less
  /// machine_from_tip(ball) at these angles.
  truth::Vec3 deviation = truth::Vec3::Zero();
};

struct AxisLocation {
  /// ISO 230-7: XOC YOC AOC BOC of a C axis; the standard uncertainty follows from the residuals and
  /// from what neighbouring ones have in common.
  std::vector<LocationResult> errors;
  std::vector<std::string> hidden;            ///< errors that these readings do not show
  truth::Vec3 setting = truth::Vec3::Zero();  ///< mm: of the sensors' zero, machine X Y Z
  double residual = 0;                        ///< mm: root mean square in one direction
};

/// Least squares with the derivatives of the error model for one micrometre and one microradian. `axis`: 3 ..
/// 8 (A .. W); `ball` in the workpiece frame. The zero position of the axis is not an unknown: with one ball
/// it cannot be told from a displacement. Throws std::runtime_error with fewer than four deviations.
AxisLocation locate_axis(const machine::MachineOutline& machine, const geometry::Chain& model,
                         std::size_t axis, const truth::Vec3& ball, double tool_length,
                         std::span<const BallDeviation> readings);

}  // namespace trunnion::identification
