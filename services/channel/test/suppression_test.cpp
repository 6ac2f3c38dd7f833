// SPDX-License-Identifier: Apache-2.0
// What a program keeps from acting on its blocks: single block (#3003), feed hold and feed override (#3004).
#include "channel_fixture.hpp"

namespace trunnion::channel::suppression_test {
namespace {

using testing::CommandKind;
using Suppression = testing::Channel;

TEST_F(Suppression, SingleBlockDoesNotStopBehindBlocksThatSuppressIt) {
  load("G90\n#3003=1\nG1 X1 F6000\nX2\n#3003=0\nX3\nX4\nM30\n");
  ASSERT_TRUE(ask(CommandKind::SINGLE_BLOCK, "", 1).accepted);
  ask(CommandKind::CYCLE_START);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  EXPECT_EQ(drive.rows.back()[0], 3) << "the first block with single block again";
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_EQ(drive.rows.back()[0], 4);
}

TEST_F(Suppression, AFeedHoldWaitsForTheBlocksBehind) {
  load("G90\n#3004=1\nG1 X5 F600\n#3004=0\nX60\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 10; ++i) round();
  ASSERT_LT(drive.rows.back()[0], 2);
  ASSERT_TRUE(ask(CommandKind::FEED_HOLD).accepted);
  EXPECT_EQ(core->run_state(), RunState::RUNNING);
  EXPECT_NE(core->state().detail.find("#3004"), std::string::npos);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  EXPECT_GT(drive.rows.back()[0], 4.8) << "it was pressed before X2";
  EXPECT_LT(drive.rows.back()[0], 6) << "10 mm/s are braked within a fraction of a millimetre";
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 60);
}

TEST_F(Suppression, AnAlarmAndAResetDoNotWait) {
  load("G90\n#3004=1\nG1 X50 F600\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  core->set_hold("Alarm 111");
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_LT(drive.rows.back()[0], 50);
  core->set_hold("");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 5; ++i) round();
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_LT(drive.rows.back()[0], 50);
}

TEST_F(Suppression, TheFeedOverrideActsBehindTheBlocksThatSuppressIt) {
  load("G90\n#3004=2\nG1 X5 F600\n#3004=0\nX60\nM30\n");
  cycles_per_round = 16;
  ASSERT_TRUE(ask(CommandKind::FEED_OVERRIDE, "", 0).accepted);
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 500; ++i) round();
  EXPECT_EQ(core->run_state(), RunState::RUNNING);
  EXPECT_GT(drive.rows.back()[0], 4.8);
  EXPECT_LT(drive.rows.back()[0], 6);
  EXPECT_NE(core->state().detail.find("the feed override is 0 %"), std::string::npos);
}

TEST_F(Suppression, TheNextProgramSuppressesNothing) {
  load("G90\n#3004=1\nG1 X1 F600\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  load("G90\nG1 X50 F600\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ask(CommandKind::FEED_HOLD);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_LT(drive.rows.back()[0], 10);
}

}  // namespace
}  // namespace trunnion::channel::suppression_test
