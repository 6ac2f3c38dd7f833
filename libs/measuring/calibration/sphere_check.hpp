// SPDX-License-Identifier: Apache-2.0
// The check of RTCP with a sphere: the control holds the centre of a sphere in the spindle at a place of the
// workpiece while the rotary axes turn.
#pragma once

#include <vector>

#include "calibration/measurement_inputs.hpp"
#include "truth/pose_report.hpp"

namespace trunnion::calibration {

/// True displacement of the sphere from where it is at the first pose, mm, in the frame of the workpiece.
std::vector<Vec3> sphere_displacements(const truth::PoseReport& machine, const ChainParameters& model,
                                       const Vec3& place, double tool_length,
                                       const std::vector<Angles>& poses);

/// `count` poses: the initial one, then random ones within `ranges`, those at which a linear axis would leave
/// its travel left out and replaced; fewer where hardly any pose is possible.
std::vector<Angles> random_check_poses(const MeasuredMachine& machine, const std::vector<AxisRange>& ranges,
                                       const Vec3& place, double tool_length, std::size_t count,
                                       std::uint64_t seed);

struct CheckSummary {
  Vec3 largest = Vec3::Zero();  ///< mm, amounts, per axis
  double root_mean_square = 0;  ///< mm, of the lengths
};
CheckSummary summary_of(const std::vector<Vec3>& displacements);

/// Both models at the same poses.
struct RtcpCheck {
  std::size_t poses = 0;
  CheckSummary before, after;
};
/// At `count` random_check_poses() of the inputs.
RtcpCheck check_rtcp(const truth::PoseReport& machine, const MeasuredMachine& measured,
                     const MeasurementInputs& inputs, const ChainParameters& before,
                     const ChainParameters& after, std::size_t count, std::uint64_t seed);

}  // namespace trunnion::calibration
