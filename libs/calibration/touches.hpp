// SPDX-License-Identifier: Apache-2.0
// Touches of a sphere: as text, and of a virtual probe on the true machine.
#pragma once

#include <string>
#include <vector>

#include "calibration/measurement_poses.hpp"
#include "truth/pose_report.hpp"
#include "truth/touch_probe.hpp"

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

/// A probe in the spindle of the true machine and a sphere on its table. `sphere` is the true centre in the
/// workpiece frame; the control expects it at inputs.sphere. Each pose is touched twice: about the expected
/// centre, then about the one that the first touches gave. Throws std::runtime_error that names pose and
/// touch: no contact within the measuring path, or contact before it.
std::vector<TouchedPose> touch_virtually(const truth::PoseReport& machine, const MeasurementInputs& inputs,
                                         const MeasuredMachine& measured, const MeasurementPlan& plan,
                                         const truth::TouchProbeTruth& probe, const Vec3& sphere);

}  // namespace trunnion::calibration
