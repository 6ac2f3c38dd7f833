// SPDX-License-Identifier: Apache-2.0
// The report of a circular test as a table and as JSON.
#pragma once

#include <string>

#include "bus/json.hpp"
#include "circular_tests/circle_report.hpp"

namespace trunnion::cli {

using circular_tests::CircleReport;

/// To standard output, um.
void print_report(const CircleReport& report);
/// One line of a table: name, value, unit.
void print_figure(const std::string& name, double value, const std::string& unit);
bus::Json report_json(const CircleReport& report);
/// [angle deg, deviation um] of each reading.
bus::Json readings_json(circular_tests::Readings readings);

}  // namespace trunnion::cli
