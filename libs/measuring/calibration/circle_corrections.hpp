// SPDX-License-Identifier: Apache-2.0
// The corrections of a kinematic chain as the manual of CYCLE9960 (A650) computes, names and counts them:
// from the circle of each rotary axis alone.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibration/measurement_inputs.hpp"

namespace trunnion::calibration {

/// A vector from the machine's base outwards, mm: of the table towards the workpiece, of the head towards the
/// tool, in the machine frame with every axis at zero.
struct ChainCorrection {
  std::string name;               ///< "CORR_C_OFFSET"; "CORR_SP1_OFFSET" leads to the spindle
  std::size_t angle = 0;          ///< of the rotary axis whose circle gives it: 0 = A .. 5 = W
  Vec3 before = Vec3::Zero();     ///< in force
  Vec3 circles = Vec3::Zero();    ///< from the circles of the axes
  Vec3 all_poses = Vec3::Zero();  ///< from the fit of all poses together, see evaluate()
};

/// A centre of the sphere on the circle of a rotary axis.
struct CircleCentre {
  Angles angles{};  ///< deg
  Vec3 difference =
      Vec3::Zero();  ///< mm: expected less measured centre in axis positions, zero at the first pose
};

/// The vectors of the chain as the manual counts their rotary axes: of type M that of the head is axis 1,
/// otherwise the one next to the machine's base.
std::vector<metrology::RootVector> counted_vectors(const ChainParameters& chain);

/// `first`: the measured centre at the initial pose, mm, axis positions. `centres`: of each rotary axis, by
/// its number. The circle of an axis runs through where the model has the ball about the axis, plus the
/// differences. Its shift across the axis is what the vectors explain, whatever the angle of the other axis;
/// along the axis the normalization decides, and without one the vector is kept. Empty when centres make no
/// circle, when a rotary axis carries a linear one, or when the angles of the other axes do not tell the
/// vectors apart. `all_poses` stays zero.
std::vector<ChainCorrection> circle_corrections(
    const ChainParameters& model, const MeasurementInputs& inputs, const Vec3& first,
    const std::map<std::size_t, std::vector<CircleCentre>>& centres);

}  // namespace trunnion::calibration
