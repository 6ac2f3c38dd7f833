// SPDX-License-Identifier: Apache-2.0
// Programs through interpreter and planner on a trunnion machine: time against the least time of their own
// path by the solver of time_scaling.hpp, which shares no code with the planner, and limits and tolerances.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <random>

#include "motion_analysis/plan_report.hpp"
#include "motion_analysis/reference_paths.hpp"

namespace trunnion::analysis {
namespace {

using Place = std::array<double, 3>;

struct TimedProgram {
  const char* name;
  std::function<std::string()> text;
  double allowed;  ///< time by the least time
};

void PrintTo(const TimedProgram& program, std::ostream* out) { *out << program.name; }

/// Lines through `count` places at F6000, coordinates rounded to multiples of `grain` mm.
std::string through_places(int count, double grain, const std::function<Place(int)>& place) {
  std::string text = "G21 G17 G90 G94 G64\n";
  for (int k = 0; k <= count; ++k) {
    char line[100];
    Place p = place(k);
    for (double& v : p) v = std::round(v / grain) * grain;
    std::snprintf(line, sizeof line, "G%d X%.5f Y%.5f Z%.5f F6000\n", k == 0 ? 0 : 1, p[0], p[1], p[2]);
    text += line;
  }
  return text + "M30\n";
}

std::string circle_in_chords() {
  return through_places(1571, 1e-4, [](int k) {
    const double angle = 2 * std::numbers::pi * k / 1571;
    return Place{25 * std::cos(angle), 25 * std::sin(angle), 0};
  });
}

std::string rose_in_chords() {
  return through_places(1500, 1e-4, [](int k) {
    const double angle = 2 * std::numbers::pi * k / 1500, r = 16 + 5 * std::cos(5 * angle);
    return Place{r * std::cos(angle), r * std::sin(angle), 0};
  });
}

// A star of nine points with waves in Z, in steps of a ten-thousandth of an inch.
std::string star_with_waves() {
  return through_places(700, 0.00254, [](int k) {
    const double angle = 2 * std::numbers::pi * k / 700, r = 11 + 3 * std::cos(9 * angle);
    return Place{r * std::cos(angle), r * std::sin(angle), 0.2 * std::sin(70 * angle)};
  });
}

std::string random_waves(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double step = 0.05 + 0.1 * unit(random), grain = std::pow(10, -2 - static_cast<int>(seed % 3));
  std::array<Place, 8> waves{};
  for (Place& wave : waves) wave = {0.3 + 5 * unit(random), 6.3 * unit(random), 0.4 * (unit(random) - 0.5)};
  return through_places(500, grain, [&](int k) {
    const double u = step * k;
    Place p{u, 4 * std::sin(0.2 * u), 0};
    for (const auto& [number, phase, height] : waves) p[2] += height / number * std::sin(number * u + phase);
    return p;
  });
}

std::string cap(ReferencePath path) {
  for (auto& command : path.program) command.modal.feed = 8000;
  return program_text(path);
}

// Semicircles of R4 to either side in turn, all tangent: LinuxCNC's open problem 3773 is an acceleration of
// eight times the limit on such arcs.
std::string tangent_semicircles() {
  std::string text = "G21 G17 G90 G94 G64\nG0 X0 Y0\n";
  for (int k = 0; k < 12; ++k)
    text += "G" + std::to_string(2 + k % 2) + " X" + std::to_string(8 * (k + 1)) + " Y0 I4 J0 F6000\n";
  return text + "M30\n";
}

// Arcs of 4 mm length and R8, tangent, to either side in turn.
std::string tangent_arcs_of_4_mm() {
  std::string text = "G21 G17 G90 G94 G64\nG0 X0 Y0\n";
  const double half = 0.25, chord = 16 * std::sin(half);  // 4 mm / 8 mm = 0.5 rad
  for (int k = 0; k < 24; ++k) {
    char line[100];
    // From the heading -half to +half and back again, so the chords lie along X.
    const double side = k % 2 == 0 ? 1 : -1;
    std::snprintf(line, sizeof line, "G%d X%.6f Y0 I%.6f J%.6f F6000\n", k % 2 == 0 ? 3 : 2, chord * (k + 1),
                  chord / 2, side * 8 * std::cos(half));
    text += line;
  }
  return text + "M30\n";
}

// A slot with round ends, four times: lines of 6 mm and semicircles of R3, all tangent. LinuxCNC's open
// problem 4149 is a motion that is slow there.
std::string tangent_lines_and_arcs() {
  std::string text = "G21 G17 G90 G94 G64\nG0 X0 Y0\n";
  for (int k = 0; k < 4; ++k) text += "G1 X6 Y0 F6000\nG3 X6 Y6 I0 J3\nG1 X0 Y6\nG3 X0 Y0 I0 J-3\n";
  return text + "M30\n";
}

class PlannedProgram : public testing::TestWithParam<TimedProgram> {};

TEST_P(PlannedProgram, KeepsItsLimitsAndIsCloseToTheLeastTimeOfItsPath) {
  const auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  channel_setup::ChannelSetup machine(tables);
  const std::string program = GetParam().text();
  language::StringSource text(program);
  const PlanReport report = plan_program(text, machine, machine.reference_position(), {});
  ASSERT_TRUE(report.result.good) << report.result.alarm;
  for (const AxisRatios& axis : report.axes) {
    EXPECT_LE(axis.velocity, 1.001);
    EXPECT_LE(axis.acceleration, 1.001);
    EXPECT_LE(axis.jerk, 1.001);
  }
  EXPECT_LE(report.deviation.contour, machine.limits().contour_tolerance + 1e-9);
  EXPECT_LE(report.deviation.orientation, machine.limits().orientation_tolerance);
  EXPECT_LE(report.motion_time, GetParam().allowed * report.least_time);
  // The solver has found that path: its differences over cycles smooth little of it.
  EXPECT_GE(report.motion_time, 0.98 * report.least_time);
}

INSTANTIATE_TEST_SUITE_P(
    Programs, PlannedProgram,
    testing::Values(
        TimedProgram{"circle in chords", circle_in_chords, 1.02},
        TimedProgram{"rose in chords", rose_in_chords, 1.02},
        TimedProgram{"relief in rows", [] { return program_text(relief(606, false)); }, 1.10},
        TimedProgram{"five-axis relief in rows", [] { return program_text(relief(404, true)); }, 1.10},
        TimedProgram{"star with waves", star_with_waves, 1.10},
        TimedProgram{"random waves 1", [] { return random_waves(1); }, 1.10},
        TimedProgram{"random waves 2", [] { return random_waves(2); }, 1.10},
        TimedProgram{"random waves 3", [] { return random_waves(3); }, 1.10},
        TimedProgram{"five-axis cap", [] { return cap(wavy_cap(60)); }, 1.04},
        TimedProgram{"three-axis cap", [] { return cap(dense_three_axis(60)); }, 1.02},
        // Where the curvature jumps, the ramps of whole cells hold: far from the least time.
        TimedProgram{"tangent semicircles", tangent_semicircles, 1.45},
        TimedProgram{"tangent arcs of 4 mm", tangent_arcs_of_4_mm, 1.10},
        TimedProgram{"stairs of lines and arcs", [] { return program_text(lines_and_arcs(60)); }, 1.10},
        TimedProgram{"tangent lines and arcs", tangent_lines_and_arcs, 1.60}));

}  // namespace
}  // namespace trunnion::analysis
