// SPDX-License-Identifier: Apache-2.0
// The paths the planner is measured with, the same in tests, in `trunnion bench motion` and as programs.
#pragma once

#include <string>
#include <vector>

#include "motion_analysis/offline_run.hpp"

namespace trunnion::analysis {

struct ReferencePath {
  std::string name;
  MachineModel machine;
  language::Transformation transformation = language::Transformation::none;
  double tool_length = 0;
  AxisValues start{};
  std::vector<language::Command> program;
  double feed_time = 0;  ///< s, length by feed alone
};

/// Limits of the references: 500 mm/s, 3000 mm/s2, 60000 mm/s3; rotary axes 360 deg/s, 3000 deg/s2, 60000
/// deg/s3.
motion::Limits reference_limits();

/// 100 mm along X at 500 mm/s.
ReferencePath single_line();
/// 50 mm along X and 50 along Y at 100 mm/s; tolerance 0 is an exact stop.
ReferencePath corner(double tolerance);
/// A full circle of R 10 mm at `feed` mm/s.
ReferencePath circle(double feed);
/// A wavy cap milled along a winding line: `length` mm in steps of 0.1 mm at F2000 on a trunnion table, the
/// tool normal to the surface, so that both rotary axes move all along. Coordinates are rounded to 0.0001 as
/// a post-processor writes them.
ReferencePath wavy_cap(double length = 300);
/// The same line without rotary axes.
ReferencePath dense_three_axis(double length = 300);
/// Rows to and fro over waves, `points` places 0.12 mm apart, coordinates rounded to 0.01 mm, F6000: kinks
/// all along. With five axes, rounded to 0.01 degrees, the tool tilts and the table turns.
ReferencePath relief(int points, bool five_axis);
/// Stairs of tangent lines of 2 mm and quarter circles of R 1 mm in turn, F6000.
ReferencePath lines_and_arcs(int count);

/// The path as a program of the interpreter's language (one block per command), for a machine with an A C
/// table and a tool 1 when it goes through a chain.
std::string program_text(const ReferencePath& path);

}  // namespace trunnion::analysis
