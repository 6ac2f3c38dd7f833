// SPDX-License-Identifier: Apache-2.0
#include "identification/circle_points.hpp"

#include "identification/true_tips.hpp"

namespace trunnion::identification {

using circular_tests::CirclePlane;
using circular_tests::PlanePoint;
using servo_analysis::ChannelMotion;

CirclePoints commanded_points(const ChannelMotion& motion, const CirclePlane& plane) {
  CirclePoints points;
  points.reserve(motion.count);
  for (std::size_t i = 0; i < motion.count; ++i)
    points.push_back({motion.commanded(plane.first, i), motion.commanded(plane.second, i)});
  return points;
}

CirclePoints encoder_points(const ChannelMotion& motion, const CirclePlane& plane) {
  CirclePoints points;
  points.reserve(motion.count);
  for (std::size_t i = 0; i < motion.count; ++i)
    points.push_back({motion.feedback(plane.first, i), motion.feedback(plane.second, i)});
  return points;
}

CirclePoints true_points(const ChannelMotion& motion, const CirclePlane& plane,
                         const circular_tests::ProgrammedCircle& circle, const truth::PoseReport& report) {
  const auto& chain = report.model();
  const double length = report.tool_length;
  truth::MachinePose middle;
  for (std::size_t axis = 0; axis < truth::axis_count; ++axis)
    middle.positions[axis] = motion.commanded(axis, 0);
  middle.positions[plane.first] = circle.centre.first;
  middle.positions[plane.second] = circle.centre.second;
  middle.tool_length = length;
  middle.temperatures = report.temperatures;
  const auto angles = geometry::angles_of(middle.positions.data());
  const auto as_axes = [&](const truth::Vec3& tip) -> PlanePoint {
    const truth::Vec3 at = chain.machine_from_tip(tip, angles, length);
    return {at[static_cast<Eigen::Index>(plane.first)], at[static_cast<Eigen::Index>(plane.second)]};
  };
  const auto ball = as_axes(report.geometry().pose(middle).tip);
  CirclePoints points;
  points.reserve(motion.count);
  for (const auto& tip : true_tips(motion, report)) {
    const auto at = as_axes(tip);
    points.push_back(
        {at.first - ball.first + circle.centre.first, at.second - ball.second + circle.centre.second});
  }
  return points;
}

}  // namespace trunnion::identification
