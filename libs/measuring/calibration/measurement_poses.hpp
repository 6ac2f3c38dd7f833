// SPDX-License-Identifier: Apache-2.0
// The poses of a measurement of the kinematics and the touches of each.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "calibration/measurement_inputs.hpp"

namespace trunnion::calibration {

/// One pose of the rotary axes, with every touch of it in the order of the motion.
struct PlannedPose {
  Angles angles{};  ///< deg
  /// Unit vectors from the centre of the sphere to the centre of the ball at the touch, in the directions of
  /// the machine's frame: the equator about the tool, then the pole.
  std::vector<Vec3> directions;
};

struct MeasurementPlan {
  /// The first is the initial pose, all axes at zero; no pose is there twice.
  std::vector<PlannedPose> poses;
  /// Of each axis of the inputs: numbers of its poses, in the order of its angles.
  std::vector<std::vector<std::size_t>> rows;
};

/// An error is one line: a pose at which a linear axis leaves its travel, or the probe meets the shaft of the
/// sphere. `inputs` have no fault_of().
std::variant<MeasurementPlan, std::string> plan_measurement(const MeasurementInputs& inputs,
                                                            const MeasuredMachine& machine);

/// One pose, with the touch angle of the first axis; the same errors.
std::variant<PlannedPose, std::string> plan_pose(const MeasurementInputs& inputs,
                                                 const MeasuredMachine& machine, const Angles& angles);

/// "A-90 C0": the rotary axes of the machine.
std::string pose_name(const Angles& angles, const ChainParameters& chain);

}  // namespace trunnion::calibration
