// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "calibration/touches.hpp"
#include "metrology/sphere.hpp"

namespace trunnion::calibration {
namespace {

constexpr double rounds = 2;

class VirtualProbe {
 public:
  VirtualProbe(const truth::PoseReport& machine, const MeasurementInputs& in,
               const truth::TouchProbeTruth& probe, const Vec3& sphere)
      : machine_(machine),
        in_(in),
        probe_(truth_of(in, probe), {truth::SphereGauge{sphere, in.sphere_diameter / 2}}),
        sphere_(sphere) {
    machine_.tool_length = in.probe_length;
  }

  // Position of X, Y, Z at the edge, on the way to the sphere against `direction`.
  Vec3 touch(const Angles& angles, const Vec3& centre, const Vec3& direction, const std::string& name) {
    const double reach = (in_.sphere_diameter + in_.ball_diameter) / 2;
    const Vec3 from = centre + (reach + in_.measuring_path) * direction;
    const Vec3 to = centre + (reach - in_.measuring_path) * direction;
    const auto start = true_tip(angles, from), end = true_tip(angles, to);
    if ((start.tip - sphere_).norm() <= reach)
      throw std::runtime_error(name + ": the probe touches before the measuring path of " + path() +
                               " mm begins; the sphere is not where it is expected");
    // Turned as the spindle is: its X is the machine's as nearly as the tool axis allows.
    const Eigen::Quaterniond inclined = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), start.axis);
    const Vec3 across = inclined * Vec3::UnitX();
    probe_.place({start.tip, across, start.axis});
    const auto share = probe_.move({end.tip, across, end.axis}, 1);
    if (!share)
      throw std::runtime_error(name + ": no contact within the measuring path of " + path() +
                               " mm before and after the expected place");
    return from + *share * (to - from);
  }

 private:
  static truth::TouchProbeTruth truth_of(const MeasurementInputs& in, truth::TouchProbeTruth probe) {
    probe.ball_radius = in.ball_diameter / 2;
    return probe;
  }
  truth::ToolPose true_tip(const Angles& angles, const Vec3& linear) const {
    truth::MachinePose pose;
    for (std::size_t i = 0; i < 3; ++i) pose.positions[i] = linear[static_cast<Eigen::Index>(i)];
    for (std::size_t i = 0; i < angles.size(); ++i) pose.positions[3 + i] = angles[i];
    pose.approach.fill(1);
    pose.tool_length = in_.probe_length;
    pose.temperatures = machine_.temperatures;
    return machine_.true_pose(pose);
  }
  std::string path() const {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", in_.measuring_path);
    return text;
  }

  truth::PoseReport machine_;
  const MeasurementInputs& in_;
  truth::TouchProbe probe_;
  Vec3 sphere_;
};

}  // namespace

std::vector<TouchedPose> touch_virtually(const truth::PoseReport& machine, const MeasurementInputs& inputs,
                                         const MeasuredMachine& measured, const MeasurementPlan& plan,
                                         const truth::TouchProbeTruth& probe, const Vec3& sphere) {
  VirtualProbe virtual_probe(machine, inputs, probe, sphere);
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(measured.model));
  std::vector<TouchedPose> poses;
  for (const auto& planned : plan.poses) {
    const auto name = pose_name(planned.angles, measured.model);
    TouchedPose& pose = poses.emplace_back(TouchedPose{planned.angles, {}});
    Vec3 expected = inputs.sphere;
    for (int round = 0; round < rounds; ++round) {
      const Vec3 centre = chain.machine_from_tip(expected, planned.angles, inputs.probe_length);
      std::vector<Vec3> tips;
      for (std::size_t i = 0; i < planned.directions.size(); ++i) {
        pose.positions.push_back(
            virtual_probe.touch(planned.angles, centre, planned.directions[i],
                                "pose " + name + ", touch " + std::to_string(pose.positions.size() + 1)));
        tips.push_back(chain.tip_from_machine(pose.positions.back(), planned.angles, inputs.probe_length));
      }
      const auto fit = metrology::fit_sphere(tips);
      if (const auto* error = std::get_if<metrology::SphereError>(&fit))
        throw std::runtime_error("pose " + name + ": " + metrology::to_string(*error));
      expected = std::get<metrology::SphereFit>(fit).centre;
    }
  }
  return poses;
}

}  // namespace trunnion::calibration
