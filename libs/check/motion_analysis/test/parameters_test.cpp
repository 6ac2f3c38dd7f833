// SPDX-License-Identifier: Apache-2.0
// The path parameters of the catalogue by their numbers: each acts on a program text.
#include <gtest/gtest.h>

#include <cmath>

#include "motion_analysis/plan_report.hpp"

namespace trunnion::analysis {
namespace {

using Settings = std::vector<std::pair<std::uint32_t, double>>;

struct Seen {
  PlanReport report;
  double slowest = 1e9;  // mm/s of the path where X is above 5 and Y below 5
  double fastest = 0;    // mm/s of the tip
};

Seen plan(const std::string& program, const Settings& settings) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.offsets.offsets.clear();
  for (const auto& [number, value] : settings) {
    EXPECT_EQ(machine::Catalogue::instance().check(number, value, ""), "");
    tables.parameters.values[number] = {value, ""};
  }
  channel_setup::ChannelSetup machine(tables);
  language::StringSource text(program);
  Seen seen;
  seen.report = plan_program(text, machine, {}, [&](const PlannedCycle& cycle) {
    if (cycle.position[0] > 5 && cycle.position[1] < 5)
      seen.slowest = std::min(seen.slowest, cycle.setpoint->path_speed);
    seen.fastest = std::max(seen.fastest, cycle.setpoint->feed);
  });
  EXPECT_TRUE(seen.report.result.good) << seen.report.result.alarm;
  return seen;
}

const std::string corner_program = "G21 G17 G90 G94 G64\nG1 X10 F600\nY10\nM30\n";
const std::string circle_program = "G21 G17 G90 G94 G64\nG0 X20\nG3 X20 Y0 I-20 J0 F12000\nM30\n";

std::string in_mode(const std::string& program, int mode) {
  return "G5.1 Q" + std::to_string(mode) + "\n" + program;
}

// A chain of 1 mm moves that turn by 30 degrees to and fro: nothing but the allowable error rounds them.
std::string small_lines() {
  std::string text = "G21 G17 G90 G94 G64\n";
  for (int k = 1; k <= 40; ++k)
    text += "G1 X" + std::to_string(k * 0.966) + " Y" + (k % 2 == 0 ? "0" : "0.259") + " F3000\n";
  return text + "M30\n";
}

// Allowable contour error of small-line blocks: 040901; 040992 and 040993 with G5.1; G64 P. The spec's value
// is 0.01 mm.
TEST(PathParameters, allowable_contour_error_of_small_line_blocks_is_used_and_kept) {
  const auto error = [](const std::string& program, const Settings& settings) {
    return plan(program, settings).report.deviation.contour;
  };
  for (const double tolerance : {0.01, 0.03}) {
    for (const double found :
         {error(small_lines(), {{40901, tolerance}}), error(in_mode(small_lines(), 1), {{40992, tolerance}}),
          error(in_mode(small_lines(), 2), {{40993, tolerance}})}) {
      EXPECT_LE(found, tolerance + 1e-9);
      EXPECT_GE(found, 0.6 * tolerance);
    }
  }
  std::string own = small_lines();
  own.replace(own.find("G64"), 3, "G64 P0.02");
  EXPECT_LE(error(own, {{40901, 0.005}}), 0.02 + 1e-9);
  EXPECT_GE(error(own, {{40901, 0.005}}), 0.6 * 0.02);
}

// Minimum smooth interior angle: 040903, 040996 and 040997. The manual says 80 to 120 degrees: the interior
// angle of 90 degrees is smooth for the one and a stop for the other.
TEST(PathParameters, minimum_smooth_interior_angle_decides_whether_motion_stops_at_a_corner_of_90_degrees) {
  const auto slowest = [](const std::string& program, std::uint32_t number, double angle) {
    return plan(program, {{number, angle}, {40901, 0.1}, {40992, 0.1}, {40993, 0.1}}).slowest;
  };
  for (const auto& [mode, number] : {std::pair(0, 40903u), {1, 40996u}, {2, 40997u}}) {
    EXPECT_GT(slowest(in_mode(corner_program, mode), number, 80), 5) << number;
    EXPECT_EQ(slowest(in_mode(corner_program, mode), number, 120), 0) << number;
  }
}

// Centripetal acceleration, 2500 to 4000 in the spec: 040904, 040998 and 040999. sqrt(a r) with r = 20 mm;
// the smaller values here are below what the axes stand.
TEST(PathParameters, centripetal_acceleration_bounds_the_speed_in_curves) {
  for (const auto& [mode, number] : {std::pair(0, 40904u), {1, 40998u}, {2, 40999u}}) {
    for (const double a : {200.0, 800.0}) {
      const double speed = std::sqrt(a * 20);
      const double found =
          plan(in_mode(circle_program, mode), {{number, a}, {100034, 1000}, {101034, 1000}}).fastest;
      EXPECT_LE(found, speed * 1.001) << number;
      EXPECT_GE(found, speed * 0.97) << number;
    }
  }
}

// Number of command smoothing cycles, 35 in the spec: 040900, 040990 and 040991. X builds its acceleration up
// in at least so many cycles: its jerk is at most acceleration / (N 0.001 s).
TEST(PathParameters, smoothing_cycles_bound_the_jerk) {
  for (const auto& [mode, number] : {std::pair(0, 40900u), {1, 40990u}, {2, 40991u}}) {
    for (const double cycles : {35.0, 10.0}) {
      const Seen seen = plan(in_mode("G21 G90 G94\nG1 X40 F6000\nM30\n", mode),
                             {{number, cycles}, {100036, 1000}, {100038, 1e8}});
      const double most = 1000 / (cycles * 0.001);
      EXPECT_NEAR(seen.report.axes[0].jerk * 1e8, most, 0.01 * most) << number;
    }
  }
}

// A limit of zero never reaches the planner: the catalogue names the parameter, whose number has the axis in
// it.
TEST(PathParameters, a_limit_of_zero_is_one_message_with_the_number_of_the_axis_and_parameter) {
  for (const std::uint32_t number : {100034u, 101035u, 102036u, 103038u}) {
    const std::string wrong = machine::Catalogue::instance().check(number, 0, "");
    EXPECT_NE(wrong.find(std::to_string(number)), std::string::npos) << wrong;
    EXPECT_NE(wrong.find("0 is outside"), std::string::npos) << wrong;
    EXPECT_EQ(wrong.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace trunnion::analysis
