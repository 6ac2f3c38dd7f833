// SPDX-License-Identifier: Apache-2.0
// What a machine builder or a programmer may get wrong about five axes, by name: each has an alarm of its own
// before anything moves.
#include <gtest/gtest.h>

#include <limits>

#include "machine/alarm_constants.hpp"
#include "machine/kinematics.hpp"
#include "reading.hpp"

namespace trunnion::channel_setup {
namespace {

using language::AlarmNumber;
using test::read;
using test::setup_of;

struct Parameter {
  const char* name;
  std::vector<std::pair<std::uint32_t, double>> values;  // over those of the AC table
  std::uint32_t alarm;
  const char* text;  // part of it
};

void PrintTo(const Parameter& p, std::ostream* out) { *out << p.name; }

class BadParameters : public testing::TestWithParam<Parameter> {};

TEST_P(BadParameters, HaveAnAlarmOfTheirOwn) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  for (const auto& [number, value] : GetParam().values) tables.parameters.values[number] = {value, ""};
  try {
    const ChannelSetup setup(std::move(tables));
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_EQ(machine::alarm_of(e).number, GetParam().alarm);
    EXPECT_NE(std::string(e.what()).find(GetParam().text), std::string::npos) << e.what();
  }
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    All, BadParameters,
    testing::Values(Parameter{"zero_direction", {{40426, 0}}, 146, "parameters 040426 .. 040428"},
                    Parameter{"zero_tool_direction", {{40402, 0}}, 146, "parameters 040400 .. 040402"},
                    Parameter{"parallel_rotary_axes", {{40426, 0}, {40428, 1}}, 147, "parallel"},
                    Parameter{"nan_offset", {{40435, nan}}, 145, "not finite"},
                    Parameter{"infinite_offset", {{40433, infinite}}, 145, "not finite"},
                    Parameter{"infinite_direction", {{40427, -infinite}}, 145, "not finite"},
                    Parameter{"nan_correction", {{40960, nan}}, 145, "not finite"},
                    Parameter{"unknown_axis", {{40425, 39}}, 142, "digit 9"},
                    Parameter{"letter_twice", {{40425, 33}}, 142, "same letter"},
                    Parameter{"linear_axes_in_a_plane", {{40932, 0}, {40933, 1}}, 142, "one plane"},
                    Parameter{"carrier_that_is_not_there", {{40907, 1}}, 142, "040905 .. 040907"},
                    Parameter{"letter_that_is_no_axis", {{40006, -1}}, 142, "turns C, which is no axis"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(BadParameters, ADirectionThatIsNotOneLongIsNormalizedWithAWarning) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.parameters.values[40426] = {-0.5, ""};
  EXPECT_EQ(machine::kinematics_warnings(tables.parameters, 0).size(), 1u);
  EXPECT_EQ(alarm::direction_not_unit.number, 148u);
  const ChannelSetup setup(std::move(tables));
  EXPECT_TRUE(setup.configured());
}

struct Program {
  const char* name;
  std::string lines;  // behind a tool length; the last one is wrong
  unsigned alarm;
  const char* text;
};

void PrintTo(const Program& p, std::ostream* out) { *out << p.name; }

class BadProgram : public testing::TestWithParam<Program> {};

TEST_P(BadProgram, HasAnAlarmOfItsOwnBeforeTheLineMoves) {
  auto setup = setup_of("ac-table");
  const std::string program = "G21 G17 G90 G54 G94 F1000\n" + GetParam().lines + "\n";
  const auto result = read(setup, program);
  EXPECT_EQ(result.alarm, GetParam().alarm) << result.text;
  EXPECT_EQ(result.line, static_cast<unsigned>(std::count(program.begin(), program.end(), '\n')));
  EXPECT_NE(result.text.find(GetParam().text), std::string::npos) << result.text;
  for (const auto& c : result.commands) EXPECT_LT(c.line, result.line);
}

unsigned number(AlarmNumber alarm) { return static_cast<unsigned>(alarm); }

// C42 takes the point (390, 150) over X417.85 (travel_test.cpp). A nutating head would be needed for a
// direction out of reach; the AC table reaches all but for its travel, A110.
INSTANTIATE_TEST_SUITE_P(
    All, BadProgram,
    testing::Values(Program{"travel_left_in_the_middle_of_a_block", "G43.4 H1\nG0 X390 Y150 Z0\nG1 C42", 140,
                            "X would go to 417.8516"},
                    Program{"travel_left_in_the_middle_of_a_vector_block",
                            "G43.5 H1\nG0 X390 Y150 Z0\nG1 I0.33456530 J-0.37157241 K0.86602540",
                            number(AlarmNumber::tool_vector_travel), "X would go to 417.8516"},
                    Program{"direction_beyond_a_rotary_travel", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J115 K0\nG53.1",
                            number(AlarmNumber::orientation_travel), "G53.1"},
                    Program{"swing_about_the_tip_without_tip_control", "G68.2 X0 Y0 Z0 I0 J10 K0\nG53.2",
                            number(AlarmNumber::tip_control_needed), "G53.2"},
                    Program{"turn_in_a_plane_without_tip_control", "G68.2 X0 Y0 Z0 I0 J10 K0\nG53.1\nG0 C10",
                            number(AlarmNumber::plane_rotary), "G0"},
                    Program{"arc_with_a_turn_in_a_plane_without_tip_control",
                            "G68.2 X0 Y0 Z0 I0 J10 K0\nG53.1\nG2 X10 I5 C10 F100",
                            number(AlarmNumber::plane_rotary), "G2"},
                    Program{"swing_without_a_plane", "G43.4 H1\nG53.1",
                            number(AlarmNumber::tilt_swing_misplaced), "G53.1"},
                    Program{"swing_beside_other_words", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.1 X1",
                            number(AlarmNumber::tilt_swing_missing), "G53.1"},
                    Program{"swing_too_late", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG0 X1",
                            number(AlarmNumber::tilt_swing_missing), "G0"},
                    Program{"plane_of_three_points_on_a_line", "G43.4 H1\nG68.1 Q1",
                            number(AlarmNumber::tilt_points), "Q1"},
                    Program{"tool_vector_without_length", "G43.5 H1\nG1 I0 J0 K0",
                            number(AlarmNumber::tool_vector_zero), "K0"}),
    [](const auto& one) { return std::string(one.param.name); });

// The head (0, 1, 1) at 45 degrees leans at most to the horizontal: of (0, 0.6, -0.8) the nearest in reach is
// (0, 1, 0), and of one rotary axis A the nearest to X is upright.
TEST(BadProgram, AnUnreachableDirectionNamesTheNearestInReach) {
  auto nutating = setup_of("nutating-b-head-c-table");
  const auto below = read(nutating, "G21 G90 G94 F1000\nG43.5 H1\nG1 I0 J0.6 K-0.8\n");
  EXPECT_EQ(below.alarm, number(AlarmNumber::orientation_impossible));
  EXPECT_EQ(below.line, 3u);
  EXPECT_NE(below.text.find("nearest I0.000000 J1.000000 K0.000000"), std::string::npos) << below.text;
  auto one_axis = setup_of("four-axis");
  const auto across = read(one_axis, "G21 G90 G94 F1000\nG43.4 H1\nG68.2 X0 Y0 Z0 I90 J30 K0\nG53.2\n");
  EXPECT_EQ(across.alarm, number(AlarmNumber::orientation_impossible));
  EXPECT_EQ(across.line, 4u);
  EXPECT_NE(across.text.find("nearest I0.000000 J0.000000 K1.000000"), std::string::npos) << across.text;
}

}  // namespace
}  // namespace trunnion::channel_setup
