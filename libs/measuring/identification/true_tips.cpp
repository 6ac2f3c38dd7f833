// SPDX-License-Identifier: Apache-2.0
#include "identification/true_tips.hpp"

#include <cmath>

namespace trunnion::identification {
namespace {

// mm or deg: commanded motions that are shorter have no direction.
constexpr double least_motion = 1e-7;

}  // namespace

std::vector<truth::Vec3> true_tips(const servo_analysis::ChannelMotion& motion,
                                   const truth::PoseReport& report) {
  truth::MachinePose pose;
  pose.tool_length = report.tool_length;
  pose.temperatures = report.temperatures;
  std::vector<truth::Vec3> tips;
  tips.reserve(motion.count);
  for (std::size_t i = 0; i < motion.count; ++i) {
    for (std::size_t axis = 0; axis < truth::axis_count; ++axis) {
      pose.positions[axis] = motion.load(axis, i);
      if (i == 0) continue;
      const double moved = motion.commanded(axis, i) - motion.commanded(axis, i - 1);
      if (std::abs(moved) > least_motion) pose.approach[axis] = moved > 0 ? 1 : -1;
    }
    tips.push_back(report.geometry().pose(pose).tip);
  }
  return tips;
}

}  // namespace trunnion::identification
