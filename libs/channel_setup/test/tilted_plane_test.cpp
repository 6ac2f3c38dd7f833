// SPDX-License-Identifier: Apache-2.0
// The planes of G68.1 Q are parameters: 04c500 .. 679, nine numbers each.
#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace trunnion::channel_setup
