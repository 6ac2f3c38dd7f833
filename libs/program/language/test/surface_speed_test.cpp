// SPDX-License-Identifier: Apache-2.0
// Constant surface speed (G96): its limit, the speed it leaves, and the pieces of moves with a feed per
// revolution.
#include <gtest/gtest.h>

#include <cmath>

#include "canonical/turning_speed.hpp"
#include "language/turned_move.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

// 200 m/min at 40 mm: 200000 mm/min over a circumference of 80 pi = 251.327 mm.
TEST(SurfaceSpeed, IsTheSpeedByTheRadiusUpToTheLimit) {
  EXPECT_NEAR(canonical::turning_speed(200, 40, 3000), 795.7747, 1e-4);
  EXPECT_NEAR(canonical::turning_speed(200, 20, 3000), 1591.5494, 1e-4);
  EXPECT_EQ(canonical::turning_speed(200, 10, 3000), 3000) << "3183.1 1/min are beyond the limit";
  EXPECT_EQ(canonical::turning_speed(200, 0, 3000), 3000) << "the centre";
  EXPECT_EQ(canonical::turning_speed(0, 0, 3000), 0);
  EXPECT_NEAR(canonical::radius_of_limit(200, 3000), 10.6103, 1e-4);
  EXPECT_EQ(canonical::lower_limit(3000, 0), 3000);
  EXPECT_EQ(canonical::lower_limit(0, 4000), 4000);
  EXPECT_EQ(canonical::lower_limit(3000, 4000), 3000);
  EXPECT_EQ(canonical::lower_limit(5000, 4000), 4000);
  EXPECT_EQ(canonical::lower_limit(0, 0), 0);
}

// 40 / 1.1^14 = 10.53, the next one would be 9.57: 14 radii and that of the limit.
TEST(SurfaceSpeed, AMoveIsDividedWhereTheSpeedHasChangedByATenth) {
  const Divisions in = divide_turned_move(40, 0, 10);
  ASSERT_EQ(in.count, 15u);
  EXPECT_NEAR(in.share[0], (40 - 40 / 1.1) / 40, 1e-12);
  EXPECT_NEAR(in.share[14], 0.75, 1e-12) << "30 of 40 mm";
  for (std::size_t i = 1; i < in.count; ++i) EXPECT_GT(in.share[i], in.share[i - 1]);
  const Divisions out = divide_turned_move(0, 40, 10);
  ASSERT_EQ(out.count, 15u);
  EXPECT_NEAR(out.share[0], 0.25, 1e-12);
  EXPECT_NEAR(out.share[1], 0.275, 1e-12) << "11 mm";
}

// 36.36, 33.06, 30.05 and 30 on the way in, 30, 33, 36.3 and 39.93 on the way out.
TEST(SurfaceSpeed, AMoveBeyondTheCentreIsDividedOnBothSides) {
  const Divisions divisions = divide_turned_move(40, -40, 30);
  ASSERT_EQ(divisions.count, 8u);
  EXPECT_NEAR(divisions.share[3], 0.125, 1e-12);
  EXPECT_NEAR(divisions.share[4], 0.875, 1e-12);
  EXPECT_EQ(divide_turned_move(5, -5, 10).count, 0u) << "the spindle has its limit";
  EXPECT_EQ(divide_turned_move(40, 40, 10).count, 0u);
  EXPECT_EQ(divide_turned_move(1000, 1, 1).count, Divisions::most);
  EXPECT_EQ(divide_turned_move(1000, -1000, 1).count, Divisions::most);
}

// The limit is at 10.61 mm: 40 / 1.1^13 = 11.59 is the last radius before it.
TEST(SurfaceSpeed, AFacingCutWithAFeedPerRevolutionIsGivenOutInPieces) {
  TestMachine machine;
  const std::string cut = "G92 S3000\nG0 X40 Z5\nG96 S200 F0.2\nG1 X0 Z4\n";
  const Interpretation result = run(machine, "G95\n" + cut);
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  ASSERT_EQ(result.commands.size(), 18u) << "rapid, S, 15 pieces, end";
  EXPECT_NEAR(result.commands[2].target[X], 40 / 1.1, 1e-12);
  EXPECT_NEAR(result.commands[2].target[Z], 4 + 1 / 1.1, 1e-12);
  EXPECT_NEAR(result.commands[15].target[X], 10.6103, 1e-4);
  EXPECT_EQ(result.commands[16].target[X], 0);
  EXPECT_EQ(result.commands[16].target[Z], 4);
  for (std::size_t i = 2; i < 17; ++i) {
    EXPECT_EQ(result.commands[i].kind, CommandKind::line);
    EXPECT_EQ(result.commands[i].line, 5u);
  }
  EXPECT_EQ(run(machine, "G94\n" + cut).commands.size(), 4u) << "one piece: rapid, S, line, end";
  machine.highest_speed = 500;  // reached at 63.66 mm
  EXPECT_EQ(run(machine, "G95\n" + cut).commands.size(), 4u) << "the speed does not change";
}

// 36.36, 33.06 and 30.05 mm are the ends of pieces.
TEST(SurfaceSpeed, OnlyTheLastPieceStopsExactly) {
  TestMachine machine;
  const Interpretation result = run(machine, "G95 G61\nG92 S3000\nG0 X40\nG96 S200 F0.2\nG1 X30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  ASSERT_EQ(result.commands.size(), 7u) << "rapid, S, four pieces, end";
  for (std::size_t i = 2; i < 5; ++i)
    EXPECT_EQ(result.commands[i].modal.path_control, PathControl::continuous);
  EXPECT_EQ(result.commands[5].modal.path_control, PathControl::exact_stop);
}

// The centre of the spindle is X = 0 of the work offset: 100 mm in machine coordinates.
TEST(SurfaceSpeed, TheRadiusCountsFromTheZeroOfTheWorkpiece) {
  TestMachine machine;
  machine.offsets[1] = {100, 0, 0, 0, 0, 0, 0, 0, 0};
  const Interpretation result = run(machine, "G55 G0 X40\nG92 S3000\nG96 S200\nG97\n");
  ASSERT_EQ(result.commands.size(), 4u);
  EXPECT_EQ(result.commands[0].target[X], 140);
  EXPECT_EQ(result.commands[2].value, 795) << "whole ones of 795.77 1/min";
  EXPECT_EQ(result.modal.spindle_speed, 795);
}

TEST(SurfaceSpeed, TheHighestSpeedOfTheSpindleIsALimit) {
  TestMachine machine;
  machine.highest_speed = 600;
  const Interpretation result = run(machine, "G0 X40\nG96 S200\nG97\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  EXPECT_EQ(result.modal.spindle_speed, 600);
}

}  // namespace
}  // namespace trunnion::language::test
