// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <stdexcept>

#include "calibration/measured_centre.hpp"

namespace trunnion::calibration {
namespace {

constexpr int rounds = 2;
constexpr double same_angle = 1e-6;  // deg

void check_done(const std::vector<TouchedPose>& done, const MeasurementPlan& plan,
                const ChainParameters& chain) {
  for (std::size_t i = 0; i < done.size(); ++i) {
    const auto name = pose_name(done[i].angles, chain);
    if (i >= plan.poses.size())
      throw std::runtime_error("pose " + name +
                               " was touched and is not planned; start again without --resume");
    const auto& planned = plan.poses[i];
    double most = 0;
    for (std::size_t k = 0; k < planned.angles.size(); ++k)
      most = std::max(most, std::abs(planned.angles[k] - done[i].angles[k]));
    if (most > same_angle)
      throw std::runtime_error("pose " + name + " was touched where " + pose_name(planned.angles, chain) +
                               " is planned; start again without --resume");
    if (done[i].positions.size() != rounds * planned.directions.size())
      throw std::runtime_error("pose " + name + " has " + std::to_string(done[i].positions.size()) +
                               " touches, " + std::to_string(rounds * planned.directions.size()) +
                               " are planned; start again without --resume");
  }
}

}  // namespace

std::vector<TouchedPose> touch_poses(const MeasurementInputs& inputs, const MeasuredMachine& measured,
                                     const MeasurementPlan& plan, const TouchRound& touch,
                                     std::vector<TouchedPose> done, const PoseDone& news) {
  check_done(done, plan, measured.model);
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(measured.model));
  double ball = inputs.ball_diameter;
  for (std::size_t i = 0; i < done.size(); ++i)
    measured_centre(inputs, measured, chain, done[i], i == 0, ball);
  for (std::size_t i = done.size(); i < plan.poses.size(); ++i) {
    const auto& planned = plan.poses[i];
    const auto name = pose_name(planned.angles, measured.model);
    TouchedPose pose{planned.angles, {}};
    Vec3 expected = inputs.sphere;
    for (int round = 0; round < rounds; ++round) {
      const auto positions =
          touch(planned, chain.machine_from_tip(expected, planned.angles, inputs.probe_length), name);
      std::vector<Vec3> tips;
      for (const auto& position : positions)
        tips.push_back(chain.tip_from_machine(position, planned.angles, inputs.probe_length));
      pose.positions.insert(pose.positions.end(), positions.begin(), positions.end());
      const auto fit = metrology::fit_sphere(tips);
      if (const auto* error = std::get_if<metrology::SphereError>(&fit))
        throw std::runtime_error("pose " + name + ": " + metrology::to_string(*error));
      expected = std::get<metrology::SphereFit>(fit).centre;
    }
    measured_centre(inputs, measured, chain, pose, done.empty(), ball);
    done.push_back(std::move(pose));
    if (news) news(done);
  }
  return done;
}

}  // namespace trunnion::calibration
