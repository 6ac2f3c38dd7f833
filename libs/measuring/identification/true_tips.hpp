// SPDX-License-Identifier: Apache-2.0
// Where the tip truly was in a motion.
#pragma once

#include <vector>

#include "servo_analysis/channel_motion.hpp"
#include "truth/pose_report.hpp"

namespace trunnion::identification {

/// At every sample: the geometry of truth.yaml at the positions of the loads; the direction of approach of an
/// axis is that of its newest commanded motion. mm, workpiece frame.
std::vector<truth::Vec3> true_tips(const servo_analysis::ChannelMotion& motion,
                                   const truth::PoseReport& report);

}  // namespace trunnion::identification
