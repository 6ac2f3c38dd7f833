// SPDX-License-Identifier: Apache-2.0
#include "calibration/ideal_touches.hpp"

#include <Eigen/LU>
#include <exception>
#include <variant>

#include "calibration/evaluation.hpp"
#include "geometry/chain.hpp"

namespace trunnion::calibration {
namespace {

constexpr int rounds_of_a_pose = 2;

}  // namespace

std::vector<TouchedPose> ideal_touches(const MeasurementInputs& in, const MeasuredMachine& machine,
                                       const MeasurementPlan& plan) {
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(machine.model));
  const double radius = (in.sphere_diameter + in.ball_diameter) / 2;
  std::vector<TouchedPose> poses;
  for (const auto& planned : plan.poses) {
    auto& pose = poses.emplace_back();
    pose.angles = planned.angles;
    // The directions are those of the axes; the sphere is round in the frame of the workpiece.
    const geometry::Mat3 to_workpiece =
        chain.jacobian(in.sphere, planned.angles, in.probe_length).tip.inverse();
    for (int round = 0; round < rounds_of_a_pose; ++round)
      for (const auto& direction : planned.directions) {
        const Vec3 outwards = (to_workpiece * direction).normalized();
        pose.positions.push_back(
            chain.machine_from_tip(in.sphere + radius * outwards, planned.angles, in.probe_length));
      }
  }
  return poses;
}

std::string evaluation_fault(const MeasurementInputs& in, const MeasuredMachine& machine,
                             const MeasurementPlan& plan,
                             const std::array<bool, metrology::slot_count>& in_correction) {
  try {
    evaluate(in, machine, ideal_touches(in, machine, plan), in_correction);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

}  // namespace trunnion::calibration
