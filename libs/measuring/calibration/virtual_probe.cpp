// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "calibration/touches.hpp"
#include "touch_probe/probe_orientation.hpp"

namespace trunnion::calibration {
namespace {

constexpr double seconds_per_minute = 60;

class VirtualProbe {
 public:
  VirtualProbe(const truth::PoseReport& machine, const MeasurementInputs& in, const ChainParameters& design,
               const touch_probe::TouchProbeTruth& probe, const std::vector<touch_probe::Solid>& solids)
      : machine_(machine), in_(in), length_(probe.length), orientation_(design), probe_(probe, solids) {}

  // Position of X, Y, Z at the edge, on the way to the sphere against `direction`.
  Vec3 touch(const Angles& angles, const Vec3& centre, const Vec3& direction, const std::string& name) {
    const double reach = (in_.sphere_diameter + in_.ball_diameter) / 2;
    const Vec3 from = centre + (reach + in_.measuring_path) * direction;
    const Vec3 to = centre + (reach - in_.measuring_path) * direction;
    const auto start = pose(angles, from), end = pose(angles, to);
    probe_.place(start);
    if (probe_.signal())
      throw std::runtime_error(name + ": the probe touches before the measuring path of " + path() +
                               " mm begins; the sphere is not where it is expected");
    const double duration = 2 * in_.measuring_path / (in_.measuring_feed / seconds_per_minute);
    const auto share = probe_.move(end, duration);
    probe_.move(start, duration);  // the contact closes
    if (!share)
      throw std::runtime_error(name + ": no contact within the measuring path of " + path() +
                               " mm before and after the expected place");
    return from + *share * (to - from);
  }

 private:
  touch_probe::ProbePose pose(const Angles& angles, const Vec3& linear) const {
    truth::MachinePose machine;
    for (std::size_t i = 0; i < 3; ++i) machine.positions[i] = linear[static_cast<Eigen::Index>(i)];
    std::copy(angles.begin(), angles.end(), machine.positions.begin() + 3);
    machine.approach.fill(1);
    machine.tool_length = length_;
    machine.temperatures = machine_.temperatures;
    const auto tool = machine_.true_pose(machine);
    return {tool.tip, orientation_.across(angles), tool.axis};
  }
  std::string path() const {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", in_.measuring_path);
    return text;
  }

  const truth::PoseReport& machine_;
  const MeasurementInputs& in_;
  double length_ = 0;
  touch_probe::ProbeOrientation orientation_;
  touch_probe::TouchProbe probe_;
};

}  // namespace

std::vector<TouchedPose> touch_virtually(const truth::PoseReport& machine, const MeasurementInputs& inputs,
                                         const MeasuredMachine& measured, const MeasurementPlan& plan,
                                         const touch_probe::TouchProbeTruth& probe,
                                         const std::vector<touch_probe::Solid>& solids) {
  VirtualProbe virtual_probe(machine, inputs, measured.outline.design, probe, solids);
  std::size_t earlier = 0;
  std::string current;
  return touch_poses(
      inputs, measured, plan, [&](const PlannedPose& pose, const Vec3& centre, const std::string& name) {
        if (name != current) current = name, earlier = 0;
        std::vector<Vec3> positions;
        for (const auto& direction : pose.directions)
          positions.push_back(virtual_probe.touch(pose.angles, centre, direction,
                                                  "pose " + name + ", touch " + std::to_string(++earlier)));
        return positions;
      });
}

}  // namespace trunnion::calibration
