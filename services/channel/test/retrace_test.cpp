// SPDX-License-Identifier: Apache-2.0
// Going back over the executed path at the operator's request.
#include <cmath>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::CommandKind;

struct Retrace : Channel {
  /// Until the drive has passed `x`.
  void run_past(const std::string& program, double farther) {
    load(program);
    cycles_per_round = 8;
    ask(CommandKind::CYCLE_START);
    for (int i = 0; i < 10000 && x() <= farther; ++i) round();
    ASSERT_EQ(core->run_state(), RunState::RUNNING);
  }
  double x() const { return drive.rows.empty() ? 0 : drive.rows.back()[0]; }
};

TEST_F(Retrace, GoesBackToTheStartOfThePathAndForwardsAgainToTheEndOfTheProgram) {
  run_past("G90\nG1 X30 Y0 F6000\nX60 Y20\nX90 Y0\nM30\n", 40);
  ASSERT_TRUE(ask(CommandKind::RETRACE, "", 1).accepted);
  EXPECT_TRUE(core->state().retracing);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_NEAR(x(), 0, 1e-9);
  EXPECT_EQ(core->state().detail, "gone back as far as the path is kept; cycle start: forwards");
  // Both blocks lie on y = 0 up to X30 and on a slope of 2 in 3 from there, rounded within 0.01 mm.
  for (const auto& row : drive.rows) ASSERT_NEAR(row[1], std::max(0.0, (row[0] - 30) * 2 / 3), 0.02);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  EXPECT_FALSE(core->state().retracing);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(x(), 90);
  const auto& limits = core->machine().limits().axes[0];
  for (std::size_t i = 2; i < drive.rows.size(); ++i)
    ASSERT_LE(std::abs(drive.rows[i][0] - 2 * drive.rows[i - 1][0] + drive.rows[i - 2][0]),
              limits.acceleration * 1e-6 * 1.001);
}

TEST_F(Retrace, OffStopsAndCycleStartGoesForwards) {
  run_past("G90\nG1 X100 F6000\nM30\n", 60);
  ask(CommandKind::RETRACE, "", 1);
  for (int i = 0; i < 10000 && (x() > 40 || i < 10); ++i) round();
  ASSERT_TRUE(ask(CommandKind::RETRACE, "", 0).accepted);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  const double held = x();
  EXPECT_GT(held, 20) << "the stop from 100 mm/s is far shorter than 20 mm";
  EXPECT_LT(held, 41);
  ask(CommandKind::CYCLE_START);
  const auto from = drive.rows.size();
  run();
  EXPECT_EQ(x(), 100);
  for (std::size_t i = from; i < drive.rows.size(); ++i) ASSERT_GE(drive.rows[i][0], held - 1e-9);
}

TEST_F(Retrace, WhatThePlcHasDoneIsNotGoneBackOver) {
  run_past("G90\nG1 X20 F6000\nM8\nG1 X60\nM30\n", 25);
  ask(CommandKind::RETRACE, "", 1);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_NEAR(x(), 20, 1e-9) << "M8 was there";
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(x(), 60);
  EXPECT_EQ(auxiliaries.size(), 2u) << "M8 once, and M30";
}

TEST_F(Retrace, AHeldProgramGoesBackFromItsPosition) {
  load("G90\nG1 X20 F6000\nM0\nG1 X60\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD) << "M0";
  ASSERT_TRUE(ask(CommandKind::RETRACE, "", 1).accepted);
  run();
  EXPECT_NEAR(x(), 0, 1e-9) << "M0 is passed";
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(x(), 60);
}

TEST_F(Retrace, WithoutAProgramOrAPathItIsRefused) {
  EXPECT_FALSE(ask(CommandKind::RETRACE, "", 1).accepted);
  load("G90\nM0\nG1 X60 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  EXPECT_EQ(ask(CommandKind::RETRACE, "", 1).reason,
            "No path is behind the program that it could go back over");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(x(), 60);
}

TEST_F(Retrace, AResetWhileGoingBackGivesTheProgramUp) {
  run_past("G90\nG1 X100 F6000\nM30\n", 60);
  ask(CommandKind::RETRACE, "", 1);
  for (int i = 0; i < 15; ++i) round();
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_FALSE(core->state().retracing);
  load("G90\nG1 X0 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(x(), 0);
}

TEST_F(Retrace, GoesBackOverFiveThousandBlocks) {
  std::string program = "G91 F6000\n";
  for (int i = 0; i < 6000; ++i) program += "G1 X0.02\n";
  load(program + "M0\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  EXPECT_NEAR(x(), 120, 1e-6);
  ask(CommandKind::RETRACE, "", 1);
  run();
  EXPECT_LE(x(), 20.02) << "5000 blocks of 0.02 mm are 100 mm";
}

}  // namespace
}  // namespace trunnion::channel
