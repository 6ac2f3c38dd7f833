// SPDX-License-Identifier: Apache-2.0
// The report of a circular test: figures of ISO 230-4 and causes, as a table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "bus/json.hpp"
#include "circular_tests/ballbar_causes.hpp"

namespace trunnion::cli {

struct CircleReport {
  std::string plane;    ///< XY, XZ or YZ
  double radius = 100;  ///< mm
  circular_tests::CircularFigures figures;
  circular_tests::BallbarCauses causes;
  std::vector<circular_tests::CauseShare> shares;  ///< with the letters of the axes
};

CircleReport circle_report(const std::string& plane, double radius, circular_tests::Readings ccw,
                           circular_tests::Readings cw);
/// To standard output, um.
void print_report(const CircleReport& report);
/// One line of a table: name, value, unit.
void print_figure(const std::string& name, double value, const char* unit);
bus::Json report_json(const CircleReport& report);
/// [angle deg, deviation um] of each reading.
bus::Json readings_json(circular_tests::Readings readings);

}  // namespace trunnion::cli
