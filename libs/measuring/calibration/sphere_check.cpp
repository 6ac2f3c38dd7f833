// SPDX-License-Identifier: Apache-2.0
#include "calibration/sphere_check.hpp"

#include <cmath>
#include <stdexcept>

#include "geometry/random_source.hpp"

namespace trunnion::calibration {
namespace {

geometry::Chain chain_of(const ChainParameters& parameters) {
  auto made = geometry::Chain::make(parameters);
  if (!std::holds_alternative<geometry::Chain>(made))
    throw std::runtime_error("the kinematic chain is refused");
  return std::get<geometry::Chain>(std::move(made));
}

}  // namespace

std::vector<Vec3> sphere_displacements(const truth::PoseReport& machine, const ChainParameters& model,
                                       const Vec3& place, double tool_length,
                                       const std::vector<Angles>& poses) {
  const auto chain = chain_of(model);
  std::vector<Vec3> displacements;
  Vec3 first = Vec3::Zero();
  for (const auto& angles : poses) {
    truth::MachinePose pose;
    const Vec3 linear = chain.machine_from_tip(place, angles, tool_length);
    for (std::size_t i = 0; i < 3; ++i) pose.positions[i] = linear[static_cast<Eigen::Index>(i)];
    for (std::size_t i = 0; i < angles.size(); ++i) pose.positions[3 + i] = angles[i];
    pose.approach.fill(1);
    pose.tool_length = tool_length;
    pose.temperatures = machine.temperatures;
    const Vec3 tip = machine.true_pose(pose).tip;
    if (displacements.empty()) first = tip;
    displacements.emplace_back(tip - first);
  }
  return displacements;
}

std::vector<Angles> random_check_poses(const MeasuredMachine& machine, const std::vector<AxisRange>& ranges,
                                       const Vec3& place, double tool_length, std::size_t count,
                                       std::uint64_t seed) {
  const auto chain = chain_of(machine.model);
  geometry::RandomSource random(seed);
  std::vector<Angles> poses{Angles{}};
  for (std::size_t tried = 0; poses.size() < count && tried < 100 * count; ++tried) {
    Angles angles{};
    for (const auto& range : ranges)
      angles[range.angle] = range.start + (range.end - range.start) * random.uniform();
    const Vec3 linear = chain.machine_from_tip(place, angles, tool_length);
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& travel = machine.outline.axes[i];
      const double position = linear[static_cast<Eigen::Index>(i)];
      inside = inside && (!travel.present || (position >= travel.low && position <= travel.high));
    }
    if (inside) poses.push_back(angles);
  }
  return poses;
}

CheckSummary summary_of(const std::vector<Vec3>& displacements) {
  CheckSummary summary;
  for (const auto& d : displacements) {
    summary.largest = summary.largest.cwiseMax(d.cwiseAbs());
    summary.root_mean_square += d.squaredNorm() / static_cast<double>(displacements.size());
  }
  summary.root_mean_square = std::sqrt(summary.root_mean_square);
  return summary;
}

RtcpCheck check_rtcp(const truth::PoseReport& machine, const MeasuredMachine& measured,
                     const MeasurementInputs& inputs, const ChainParameters& before,
                     const ChainParameters& after, std::size_t count, std::uint64_t seed) {
  const auto poses =
      random_check_poses(measured, inputs.axes, inputs.sphere, inputs.probe_length, count, seed);
  const auto summary = [&](const ChainParameters& model) {
    return summary_of(sphere_displacements(machine, model, inputs.sphere, inputs.probe_length, poses));
  };
  return {poses.size(), summary(before), summary(after)};
}

}  // namespace trunnion::calibration
