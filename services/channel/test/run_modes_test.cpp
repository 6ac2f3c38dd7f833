// SPDX-License-Identifier: Apache-2.0
// Dry run, locks and block skip.
#include <cmath>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::CommandKind;

TEST_F(Channel, ADryRunMovesAtTheFeedOfItsParameterWhateverTheProgramProgrammed) {
  load("G90\nG1 X100 F100\nG93 X0 F0.01\nM30\n");
  ASSERT_TRUE(ask(CommandKind::DRY_RUN, "", 1).accepted);
  EXPECT_TRUE(core->state().dry_run);
  ask(CommandKind::CYCLE_START);
  run();
  double fastest = 0;
  for (std::size_t i = 1; i < drive.rows.size(); ++i)
    fastest = std::max(fastest, std::abs(drive.rows[i][0] - drive.rows[i - 1][0]));
  EXPECT_NEAR(fastest, 2000.0 / 60 * 0.001, 1e-9) << "parameter 04c914 is 2000 mm/min, a cycle 1 ms";
  // 200 mm at 2000 mm/min take 6 s; 100 mm at F100 alone would take 60 s.
  EXPECT_LT(drive.rows.size(), 7000u);
}

TEST_F(Channel, LockedAxesAreAtRestWhileTheProgramRunsAndItsPositionsAreShown) {
  load("G90\nG1 X50 Y20 F6000\nM30\n");
  ASSERT_TRUE(ask(CommandKind::AXIS_LOCK, "", 1).accepted);
  EXPECT_EQ(core->state().locked, (std::vector<std::uint8_t>{1, 0, 0}));
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  for (const auto& row : drive.rows) ASSERT_EQ(row[0], 0);
  EXPECT_EQ(drive.rows.back()[1], 20);
  EXPECT_EQ(core->state().machine[0], 50) << "where the program thinks X is";
  EXPECT_EQ(core->state().machine[1], 20);
}

TEST_F(Channel, WithTheLockOffThePositionIsThatOfTheAxesAgain) {
  load("G90\nG1 X50 F6000\nM30\n");
  ask(CommandKind::AXIS_LOCK, "", 7);
  ask(CommandKind::CYCLE_START);
  run();
  ASSERT_TRUE(ask(CommandKind::AXIS_LOCK, "", 0).accepted);
  EXPECT_EQ(core->state().machine[0], 0);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(drive.rows.back()[0], 50);
  for (std::size_t i = 1; i < drive.rows.size(); ++i)
    ASSERT_LT(std::abs(drive.rows[i][0] - drive.rows[i - 1][0]), 0.2) << "no jump";
}

TEST_F(Channel, SwitchesAreRefusedWhileAProgramRuns) {
  load("G90\nG1 X50 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 5; ++i) round();
  for (const auto kind : {CommandKind::DRY_RUN, CommandKind::AXIS_LOCK, CommandKind::AUXILIARY_LOCK,
                          CommandKind::BLOCK_SKIP, CommandKind::HANDWHEEL_OFFSET})
    EXPECT_FALSE(ask(kind, "", 1).accepted);
  EXPECT_FALSE(core->state().dry_run);
}

TEST_F(Channel, TheAuxiliaryLockPassesOverFunctionsButNotStopsAndTheEnd) {
  load("G90\nT1 M6\nS500 M3\nG1 X5 F6000\nM8\nM0\nM30\n");
  ASSERT_TRUE(ask(CommandKind::AUXILIARY_LOCK, "", 1).accepted);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD) << "M0";
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  std::vector<std::uint32_t> sent;
  for (const auto& a : auxiliaries) sent.push_back(a.code);
  EXPECT_EQ(sent, (std::vector<std::uint32_t>{0, 30}));
  EXPECT_EQ(core->state().tool, 0u) << "no tool was changed";
}

TEST_F(Channel, BlocksOfTheChosenSkipLevelsAreLeftOut) {
  load("G90 F6000\nG1 X1\n/G1 X2\n/3 G1 X3\nM30\n");
  const auto end_with = [&](double mask) {
    EXPECT_TRUE(ask(CommandKind::BLOCK_SKIP, "", mask).accepted);
    ask(CommandKind::CYCLE_START);
    run();
    return drive.rows.back()[0];
  };
  EXPECT_EQ(end_with(0), 3);
  EXPECT_EQ(end_with(0b100), 2) << "level 3";
  EXPECT_EQ(end_with(0b101), 1) << "levels 1 and 3";
  EXPECT_FALSE(ask(CommandKind::BLOCK_SKIP, "", 512).accepted);
}

TEST_F(Channel, AFeedOverrideOfZeroIsReportedInTheState) {
  load("G90\nG1 X50 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 5; ++i) round();
  ask(CommandKind::FEED_OVERRIDE, "", 0);
  for (int i = 0; i < 100; ++i) round();
  EXPECT_EQ(core->state().detail, "the feed override is 0 %");
  ask(CommandKind::FEED_OVERRIDE, "", 1);
  run();
  EXPECT_EQ(drive.rows.back()[0], 50);
  EXPECT_EQ(core->state().detail, "");
}

TEST_F(Channel, AChannelThatWaitsForItsTextReportsIt) {
  text = "G90\nG1 X10 F6000\n";
  while (text.size() < 3 * ProgramText::chunk_size) text += "G1 X10.5\nG1 X10\n";
  load(text + "M30\n");
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 3; ++i) core->advance();  // the text is not delivered
  EXPECT_TRUE(core->waits_for_text());
  EXPECT_EQ(core->state().detail, "waiting for the text of the program");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_FALSE(core->waits_for_text());
}

TEST_F(Channel, APartIsAProgramThatEndsByM2OrM30AndIsNoTest) {
  const auto parts_after = [&](const std::string& text) {
    load(text);
    EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    return core->state().parts;
  };
  EXPECT_EQ(parts_after("G90\nG1 X5 F6000\nM30\n"), 1u);
  EXPECT_EQ(parts_after("G90\nG1 X0 F6000\nM2\n"), 2u);
  EXPECT_EQ(parts_after("G90\nG1 X5 F6000\n"), 2u) << "it ends where its text ends";
  ask(CommandKind::DRY_RUN, "", 1);
  EXPECT_EQ(parts_after("G90\nG1 X0 F6000\nM30\n"), 2u);
  ask(CommandKind::DRY_RUN, "", 0);
  ask(CommandKind::AUXILIARY_LOCK, "", 1);
  EXPECT_EQ(parts_after("G90\nG1 X5 F6000\nM30\n"), 2u);
  ask(CommandKind::AUXILIARY_LOCK, "", 0);
  load("G90\nG1 X50 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  run(5);
  ASSERT_EQ(core->run_state(), RunState::RUNNING);
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->state().parts, 2u) << "reset";
  ASSERT_TRUE(ask({.command = CommandKind::SET_PARTS, .parts = 41}).accepted);
  EXPECT_EQ(parts_after("G90\nG1 X0 F6000\nM30\n"), 42u);
  // The next process continues the count of the one before.
  EXPECT_EQ(core->running_program().parts, 42u);
}

}  // namespace
}  // namespace trunnion::channel
