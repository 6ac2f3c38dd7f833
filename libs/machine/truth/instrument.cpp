// SPDX-License-Identifier: Apache-2.0
#include "truth/instrument.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace trunnion::truth {

double laser_distance(const LaserSetup& setup, const ToolPose& tool) {
  return setup.along.dot(tool.tip - setup.zero.tip);
}

double laser_straightness(const LaserSetup& setup, const ToolPose& tool) {
  return setup.across.dot(tool.tip - setup.zero.tip);
}

double laser_angle(const LaserSetup& setup, const ToolPose& tool) {
  return setup.along.cross(setup.across).dot(setup.zero.axis.cross(tool.axis));
}

double dial(const Vec3& zero, const Vec3& plunger, const Vec3& tip) { return plunger.dot(tip - zero); }

Nest Nest::at(const Vec3& centre) {
  Nest nest;
  nest.centre = centre;
  // The unit vectors of a cube that stands on its corner.
  const double third = std::sqrt(1 / 3.0), half = std::sqrt(0.5), sixth = std::sqrt(1 / 6.0);
  nest.directions = {Vec3(2 * sixth, 0, third), Vec3(-sixth, half, third), Vec3(-sixth, -half, third)};
  return nest;
}

std::array<double, 3> Nest::readings(const Vec3& tip) const {
  return {directions[0].dot(tip - centre), directions[1].dot(tip - centre), directions[2].dot(tip - centre)};
}

Vec3 Nest::place(const std::array<double, 3>& readings) const {
  Mat3 rows;
  for (int i = 0; i < 3; ++i) rows.row(i) = directions[static_cast<std::size_t>(i)].transpose();
  return centre + rows.inverse() * Vec3(readings[0], readings[1], readings[2]);
}

}  // namespace trunnion::truth
