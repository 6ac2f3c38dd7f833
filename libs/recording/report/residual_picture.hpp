// SPDX-License-Identifier: Apache-2.0
// Picture of a measurement of the kinematics, SVG.
#pragma once

#include <string>

#include "calibration/evaluation.hpp"

namespace trunnion::report {

/// Differences before and residuals after of each pose, in um.
std::string residual_picture(const calibration::KinematicsResult& result, const std::string& title);

}  // namespace trunnion::report
