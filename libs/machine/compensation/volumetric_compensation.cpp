// SPDX-License-Identifier: Apache-2.0
#include "compensation/volumetric_compensation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"

namespace trunnion::volumetric {
namespace {

using Normal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using geometry::radians_per_degree;

}  // namespace

std::variant<VolumetricCompensation, std::string> VolumetricCompensation::make(
    const geometry::ChainParameters& design, const GeometryErrors& errors,
    const CompensationSettings& settings) {
  auto model = ErrorModel::make(design, errors);
  if (auto* refused = std::get_if<std::string>(&model)) return std::move(*refused);
  VolumetricCompensation made(std::get<ErrorModel>(std::move(model)), settings);
  made.settings_.damping = std::max(made.settings_.damping, 1e-4);
  for (const auto& axis : made.model_.errors().structure)
    if (axis.axis > 2 && settings.orientation && made.rotary_count_ < made.rotary_.size())
      made.rotary_[made.rotary_count_++] = axis.axis;
  return made;
}

PositionCorrection VolumetricCompensation::correction(const MachinePose& commanded) const {
  const ToolPose target = model_.ideal_pose(commanded);
  MachinePose machine = commanded;
  PositionCorrection result;
  const auto count = static_cast<Eigen::Index>(rotary_count_);
  const double damping = settings_.damping * settings_.damping;
  while (result.iterations < most_iterations) {
    const auto now = model_.derivatives(machine);
    Vec3 error = target.tip - now.pose.tip;
    const bool turn = count > 0 && result.iterations < rotary_steps;
    if (turn) {
      const Vec3 direction_error = target.axis - now.pose.axis;
      Normal normal(count, count);
      Unknowns step(count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const Vec3& by_i = now.axis[rotary_[static_cast<std::size_t>(i)]];
        step[i] = by_i.dot(direction_error);
        for (Eigen::Index k = 0; k < count; ++k)
          normal(i, k) = by_i.dot(now.axis[rotary_[static_cast<std::size_t>(k)]]) + (i == k ? damping : 0.0);
      }
      step = normal.llt().solve(step).eval();
      for (Eigen::Index i = 0; i < count; ++i) {
        const auto axis = rotary_[static_cast<std::size_t>(i)];
        error -= step[i] * now.tip[axis];
        machine.positions[axis] += step[i] / radians_per_degree;
      }
    }
    Mat3 linear;
    for (Eigen::Index i = 0; i < 3; ++i) linear.col(i) = now.tip[static_cast<std::size_t>(i)];
    if (!(std::abs(linear.determinant()) > geometry::parallel_sine)) break;
    const Vec3 step = linear.inverse() * error;
    for (std::size_t i = 0; i < 3; ++i) machine.positions[i] += step[static_cast<Eigen::Index>(i)];
    ++result.iterations;
    const double length = step.norm();
    if (!(length < 1e6)) break;
    if (turn || !(length < last_step)) continue;
    for (std::size_t i = 0; i < axis_count; ++i)
      result.added[i] = machine.positions[i] - commanded.positions[i];
    return result;
  }
  result.converged = false;
  return result;
}

}  // namespace trunnion::volumetric
