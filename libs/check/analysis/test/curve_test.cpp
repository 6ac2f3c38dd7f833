// SPDX-License-Identifier: Apache-2.0
// A NURBS curve is smooth motion, not many short lines with corners.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/program_run.hpp"

namespace trunnion::analysis {
namespace {

struct CurveRun {
  double slowest = 1e9;       // mm/s on the curve, away from its ends
  double acceleration = 0;    // mm/s2 of the tip there
  double off_the_circle = 0;  // mm, everywhere
};

// Three quarter circles of R 20 mm about (0, 0), each by weights 1, cos 45, 1, from (20, 0) to (0, -20).
CurveRun run_curve(const std::string& path_control, const std::string& tolerance) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.offsets.offsets.clear();
  tables.parameters.values[40901] = {std::stod(tolerance), ""};
  channel_setup::ChannelSetup machine(tables);
  const std::string program = "G21 G17 G90 G94 " + path_control +
                              "\nG0 X20 Y0 Z0\nG6.2 P3 K0 X20 Y0 R1 F3000\nK0 X20 Y20 R0.70710678118654752\n"
                              "K0 X0 Y20 R1\nK1 X-20 Y20 R0.70710678118654752\nK1 X-20 Y0 R1\n"
                              "K2 X-20 Y-20 R0.70710678118654752\nK2 X0 Y-20 R1\nK3\nK3\nK3\nM30\n";
  language::StringSource text(program);
  CurveRun result;
  AxisValues before{}, last{};
  const auto run = run_program(
      text, machine, {},
      [&](const PlannedCycle& cycle) {
        const AxisValues& p = cycle.tip;
        if (cycle.setpoint->line > 2) {
          result.off_the_circle = std::max(result.off_the_circle, std::abs(std::hypot(p[0], p[1]) - 20));
          const double angle = std::atan2(p[1], p[0]);
          if (angle > 0.8 || angle < -2.4) {  // behind and before the ramps, of 4 mm
            result.slowest = std::min(result.slowest, cycle.setpoint->feed);
            const double ax = p[0] - 2 * last[0] + before[0], ay = p[1] - 2 * last[1] + before[1];
            result.acceleration = std::max(result.acceleration, std::hypot(ax, ay) * 1e6);
          }
        }
        before = last;
        last = p;
      },
      {});
  EXPECT_TRUE(run.good) << run.alarm;
  return result;
}

// 50 mm/s on R 20 mm are 125 mm/s2 towards the centre. Chords of 0.0025 mm have corners of 1.81 degrees: gone
// through in a cycle they would ask for 1,580 mm/s2, and stood at, for a feed of 0.
TEST(Curve, keeps_its_feed_and_the_acceleration_of_its_curvature) {
  for (const std::string control : {"G64", "G61"}) {
    for (const std::string tolerance : {"0.01", "0"}) {
      const CurveRun run = run_curve(control, tolerance);
      SCOPED_TRACE(control + " " + tolerance);
      EXPECT_GE(run.slowest, 0.98 * 50);
      EXPECT_LE(run.acceleration, 1.3 * 125);
      EXPECT_LE(run.off_the_circle, std::max(0.005, std::stod(tolerance)) + 1e-9);
    }
  }
}

}  // namespace
}  // namespace trunnion::analysis
