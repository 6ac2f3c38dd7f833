// SPDX-License-Identifier: Apache-2.0
// The points of a motion in a plane of two linear axes, for a circular test.
#pragma once

#include <vector>

#include "circular_tests/circle_program.hpp"
#include "circular_tests/turns.hpp"
#include "servo_analysis/channel_motion.hpp"
#include "truth/pose_report.hpp"

namespace trunnion::identification {

using CirclePoints = std::vector<circular_tests::PlanePoint>;

CirclePoints commanded_points(const servo_analysis::ChannelMotion& motion,
                              const circular_tests::CirclePlane& plane);
/// By the position loops.
CirclePoints encoder_points(const servo_analysis::ChannelMotion& motion,
                            const circular_tests::CirclePlane& plane);
/// The true tip as positions of X, Y and Z of a machine without errors; the ball of the table is set where
/// the tip truly is at the centre.
CirclePoints true_points(const servo_analysis::ChannelMotion& motion,
                         const circular_tests::CirclePlane& plane,
                         const circular_tests::ProgrammedCircle& circle, const truth::PoseReport& report);

}  // namespace trunnion::identification
