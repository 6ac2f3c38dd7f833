// SPDX-License-Identifier: Apache-2.0
// The report of a circular test: figures of ISO 230-4 and causes.
#pragma once

#include <string>
#include <vector>

#include "circular_tests/ballbar_causes.hpp"

namespace trunnion::circular_tests {

struct CircleReport {
  std::string plane;    ///< XY, XZ or YZ
  double radius = 100;  ///< mm
  CircularFigures figures;
  BallbarCauses causes;
  std::vector<CauseShare> shares;  ///< with the letters of the axes
};

CircleReport circle_report(const std::string& plane, double radius, Readings ccw, Readings cw);

}  // namespace trunnion::circular_tests
