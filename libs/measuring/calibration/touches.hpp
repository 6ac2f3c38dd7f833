// SPDX-License-Identifier: Apache-2.0
// Touches of a sphere: as text, the procedure, and those of a virtual probe on the true machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/measurement_poses.hpp"
#include "touch_probe/touch_probe.hpp"
#include "truth/pose_report.hpp"

namespace trunnion::calibration {

/// The touches of one pose.
struct TouchedPose {
  Angles angles{};              ///< deg
  std::vector<Vec3> positions;  ///< mm: of X, Y and Z at the edge of the probe, as latched
};

/// Each line is one touch: `A-90 C0 X101.2345 Y-20.001 Z-310.5`, the axis words in any order, rotary axes of
/// the machine that are not named at zero; `#` begins a comment. Lines that follow each other with the same
/// rotary positions are one pose. At most 1000 lines. Throws std::runtime_error that begins with
/// file:line:column.
std::vector<TouchedPose> parse_touches(const std::string& text, const std::string& file,
                                       const ChainParameters& chain);
/// The same, to 1 nm.
std::string text_of(const std::vector<TouchedPose>& poses, const ChainParameters& chain);

/// Touches the sphere along each of the pose's directions, about `centre`: the position of X, Y and Z, mm,
/// with the ball's centre in that of the sphere. Returns the position at the edge of each. `name`: of the
/// pose. Throws std::runtime_error that names it.
using TouchRound =
    std::function<std::vector<Vec3>(const PlannedPose& pose, const Vec3& centre, const std::string& name)>;
/// Is told of each pose that is complete; `poses` are all so far.
using PoseDone = std::function<void(const std::vector<TouchedPose>& poses)>;

/// The poses of the plan one after the other, each touched twice: about the expected centre, then about the
/// one that the first touches gave. `done` are poses that were touched before; they must be the first ones of
/// the plan. Throws std::runtime_error.
std::vector<TouchedPose> touch_poses(const MeasurementInputs& inputs, const MeasuredMachine& measured,
                                     const MeasurementPlan& plan, const TouchRound& touch,
                                     std::vector<TouchedPose> done = {}, const PoseDone& news = {});

/// A touch probe in the spindle of the true machine among solids in the workpiece frame, as the drive's
/// simulation has them. The control expects probe and sphere as in `inputs`. The ball moves to the sphere at
/// inputs.measuring_feed. Throws std::runtime_error that names pose and touch: no contact within the
/// measuring path, or contact before it.
std::vector<TouchedPose> touch_virtually(const truth::PoseReport& machine, const MeasurementInputs& inputs,
                                         const MeasuredMachine& measured, const MeasurementPlan& plan,
                                         const touch_probe::TouchProbeTruth& probe,
                                         const std::vector<touch_probe::Solid>& solids);

}  // namespace trunnion::calibration
