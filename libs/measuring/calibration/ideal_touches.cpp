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
                                       const MeasurementPlan& plan, const Vec3& beside) {
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(machine.model));
  const double radius = (in.sphere_diameter + in.ball_diameter) / 2;
  const Vec3 sphere = in.sphere + beside;
  std::vector<TouchedPose> poses;
  for (const auto& planned : plan.poses) {
    auto& pose = poses.emplace_back();
    pose.angles = planned.angles;
    // The directions are those of the axes; the sphere is round in the frame of the workpiece.
    const geometry::Mat3 to_workpiece = chain.jacobian(sphere, planned.angles, in.probe_length).tip.inverse();
    for (int round = 0; round < rounds_of_a_pose; ++round)
      for (const auto& direction : planned.directions) {
        const Vec3 outwards = (to_workpiece * direction).normalized();
        pose.positions.push_back(
            chain.machine_from_tip(sphere + radius * outwards, planned.angles, in.probe_length));
      }
  }
  return poses;
}

std::string evaluation_fault(const MeasurementInputs& in, const MeasuredMachine& machine,
                             const MeasurementPlan& plan,
                             const std::array<bool, metrology::slot_count>& in_correction) {
  std::string fault;
  // Where a sphere is expected on the axis of a table, rounding decides about its circle; the true one is
  // somewhere in the confidence range.
  const Vec3 within = in.confidence_range / 2 * Vec3(1, 1, 1).normalized();
  for (const Vec3& beside : {Vec3(Vec3::Zero()), within}) {
    try {
      evaluate(in, machine, ideal_touches(in, machine, plan, beside), in_correction);
      return "";
    } catch (const std::exception& e) {
      if (fault.empty()) fault = e.what();
    }
  }
  return fault;
}

}  // namespace trunnion::calibration
