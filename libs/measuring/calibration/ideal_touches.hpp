// SPDX-License-Identifier: Apache-2.0
// What the evaluation refuses whatever is touched, found before the first touch.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "calibration/measurement_poses.hpp"
#include "calibration/touches.hpp"
#include "metrology/chain_vectors.hpp"

namespace trunnion::calibration {

/// Touches of every pose of the plan on a machine that is as its parameters have it, with the sphere `beside`
/// the place where it is expected, mm in the workpiece frame.
std::vector<TouchedPose> ideal_touches(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                                       const MeasurementPlan& plan, const Vec3& beside = Vec3::Zero());

/// Why evaluate() would refuse ideal touches, and so those of any machine, in one line: normalizations that
/// fix a component twice, a triangle of centres that is too flat, another work offset than that of the
/// reference. "" when it would not for one place of the sphere within the confidence range. `in_correction`
/// as in evaluate().
std::string evaluation_fault(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                             const MeasurementPlan& plan,
                             const std::array<bool, metrology::slot_count>& in_correction = {});

}  // namespace trunnion::calibration
