// SPDX-License-Identifier: Apache-2.0
// The centre of the sphere by the touches of one pose, with the checks that stop a measurement.
#pragma once

#include "calibration/touches.hpp"
#include "metrology/sphere.hpp"

namespace trunnion::calibration {

struct MeasuredCentre {
  metrology::SphereFit fit;  ///< with the known radius; centre in the workpiece frame, mm
  double diameter = 0;       ///< mm, of the sphere, by a fit with a free radius
  /// Variance of the radius of that fit for touches of variance 1.
  double radius_cofactor = 0;
};

/// `ball_diameter`: effective diameter of the ball, mm; the initial pose (`initial`) sets it when the inputs
/// ask for the calibration of the probe. Throws std::runtime_error: one line with the pose, the value and the
/// limit, when the diameter or the centre is beyond its tolerance.
MeasuredCentre measured_centre(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                               const geometry::Chain& chain, const TouchedPose& pose, bool initial,
                               double& ball_diameter);

}  // namespace trunnion::calibration
