// SPDX-License-Identifier: Apache-2.0
// The volumetric error of a machine as a picture.
#pragma once

#include <string>

#include "truth/pose_report.hpp"

namespace trunnion::cli {

/// Three planes through the middle of the travel (XY, XZ, YZ), rotary axes at zero: the grid of the travel,
/// and the same grid with the deviation of the tip magnified. SVG.
std::string truth_picture(const truth::PoseReport& report, const truth::MachineOutline& machine,
                          const std::string& title);

}  // namespace trunnion::cli
