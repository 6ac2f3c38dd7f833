// SPDX-License-Identifier: Apache-2.0
// The planes of G68.1 Q are parameters: 04c500 .. 679, nine numbers each.
#include <gtest/gtest.h>

#include <cmath>

#include "machine/parameter_constants.hpp"
#include "reading.hpp"

namespace trunnion::channel_setup {
namespace {

// Origin (10, 20, 30), +X through (11, 20, 30) and a point (10, 21, 31) with positive Y: the plane is the
// workpiece's turned by 45 degrees about X. Its Z is (0, -sin 45, cos 45), for which the table stands at A45
// (docs/kinematics.md, Signs), and Y5 on it is 5 (0, sin 45, cos 45) beside the origin.
class TiltedPlane : public testing::TestWithParam<std::uint32_t> {};

TEST_P(TiltedPlane, OfThreePointsIsTheOneOfItsParameters) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  const std::uint32_t first = 40500 + 9 * (GetParam() - 1);
  const double points[] = {10, 20, 30, 11, 20, 30, 10, 21, 31};
  for (std::uint32_t i = 0; i < 9; ++i) tables.parameters.values[first + i] = {points[i], ""};
  ChannelSetup setup(std::move(tables));
  const auto result = test::read(setup, "G21 G17 G90 G54 G94 F1000\nG43.4 H1\nG68.1 Q" +
                                            std::to_string(GetParam()) + "\nG53.1\nG0 X0 Y5 Z0\n");
  ASSERT_EQ(result.alarm, 0u) << result.text;
  const auto& move = result.commands[result.commands.size() - 2];  // the last is the end
  ASSERT_EQ(move.line, 5u);
  const auto offset = setup.work_offset(0);
  const double beside = 5 * std::sqrt(0.5);
  EXPECT_NEAR(move.target[language::X] - offset[language::X], 10, 1e-9);
  EXPECT_NEAR(move.target[language::Y] - offset[language::Y], 20 + beside, 1e-9);
  EXPECT_NEAR(move.target[language::Z] - offset[language::Z], 30 + beside, 1e-9);
  EXPECT_NEAR(move.target[language::A], 45, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Q, TiltedPlane, testing::Values(1u, 2u, 19u, 20u));

TEST(TiltedPlaneNumber, TwentyOneIsAnAlarm) {
  auto setup = test::setup_of("ac-table");
  const auto result = test::read(setup, "G21 G90 G94 F1000\nG43.4 H1\nG68.1 Q21\n");
  EXPECT_EQ(result.alarm, static_cast<unsigned>(language::AlarmNumber::value_range)) << result.text;
  EXPECT_EQ(result.line, 3u);
}

// I10 J20 K30: with P1 of Fanuc's rule the plane of G68.3, without P that of Euler's angles.
TEST(TiltedPlaneByAngles, PStatesTheirKindWhereTheParameterSaysSo) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.parameters.values[parameter::plane_angles.number()] = {1, ""};
  ChannelSetup setup(std::move(tables));
  const auto matrix_of = [&](const std::string& words) {
    const auto result = test::read(setup, "G21 G90 G94 F1000\n" + words + "\nG53.1\n");
    EXPECT_EQ(result.alarm, 0u) << result.text;
    return result.commands.empty() ? language::Tilt{}.matrix : result.commands.back().modal.tilt.matrix;
  };
  const std::string angles = " X0 Y0 Z0 I10 J20 K30";
  EXPECT_EQ(matrix_of("G68.2 P1" + angles), matrix_of("G68.3" + angles));
  EXPECT_EQ(matrix_of("G68.2 P0" + angles), matrix_of("G68.2" + angles));
  EXPECT_NE(matrix_of("G68.2 P1" + angles), matrix_of("G68.2" + angles));
  EXPECT_EQ(test::read(setup, "G68.2 P2" + angles + "\n").alarm,
            static_cast<unsigned>(language::AlarmNumber::value_range));
}

// Both orders bring the tip to the same points of the plane.
TEST(TiltedPlaneWithoutTipControl, AToolLengthBehindTheSwingActsAlongTheTool) {
  auto setup = test::setup_of("ac-table");
  const std::string plane = "G68.2 X5 Y6 Z7 I0 J45 K0\nG53.1\n";
  const auto tip =
      test::read(setup, "G21 G17 G90 G54 G94 F1000\nG43.4 H1\n" + plane + "G0 Z50\nX10 Y10\nG69\n");
  const auto plain =
      test::read(setup, "G21 G17 G90 G54 G94 F1000\n" + plane + "G43 H1 Z50\nG0 X10 Y10\nG69\nG0 Z200\n");
  ASSERT_EQ(tip.alarm, 0u) << tip.text;
  ASSERT_EQ(plain.alarm, 0u) << plain.text;
  const auto machine_at = [&](const test::Reading& reading, std::uint32_t line) {
    AxisValues machine{};
    for (const auto& command : reading.commands)
      if (command.line == line && command.kind == language::CommandKind::rapid)
        machine = setup.machine_from_tip(command.target, command.modal.tool_length);
    return machine;
  };
  const auto expected = machine_at(tip, 6), found = machine_at(plain, 5);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
  EXPECT_NE(expected[language::A], 0);
  // Behind G69 the length of G43 is in Z of the machine again.
  const auto& last = plain.commands[plain.commands.size() - 2];
  ASSERT_EQ(last.line, 7u);
  EXPECT_EQ(last.modal.transformation, language::Transformation::none);
  EXPECT_EQ(last.modal.length_offset, 1u);
  EXPECT_NEAR(last.target[language::Z], 200 + setup.work_offset(0)[language::Z] + last.modal.tool_length,
              1e-9);
}

}  // namespace
}  // namespace trunnion::channel_setup
