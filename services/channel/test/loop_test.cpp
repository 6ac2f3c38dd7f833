// SPDX-License-Identifier: Apache-2.0
// Programs that read lines for ever, or for long, without a motion.
#include <string>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::CommandKind;

struct Loop : Channel {
  /// Rounds until the loop is shown and the path before it is done; each reads on `reads` times.
  void run_into_loop(int reads) {
    for (int i = 0; i < 1000 && !(core->loops() && core->link().state() == LinkState::idle); ++i) round();
    ASSERT_TRUE(core->loops());
    for (int i = 0; i < reads; ++i) core->read_on();
  }
};

TEST_F(Loop, ALineOfMdiThatRepeatsForEverIsShownAndEndsByReset) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "M99").accepted);
  run_into_loop(10);
  EXPECT_EQ(core->run_state(), RunState::RUNNING);
  EXPECT_FALSE(core->waits_for_text()) << "the program service is not to blame";
  // 20,000 until it counts as a loop, and 8,000 with each of ten.
  EXPECT_EQ(core->state().detail, "line 1: 100,000 lines were read without a motion; reset ends it");
  for (int i = 0; i < 150; ++i) core->read_on();
  EXPECT_EQ(core->state().detail, "line 1: 1.3 million lines were read without a motion; reset ends it");
  ASSERT_TRUE(ask(CommandKind::RESET).accepted);
  round();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(core->state().detail, "");
  EXPECT_TRUE(events.empty());
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G0 X3").accepted);
  run();
  EXPECT_EQ(drive.rows.back()[0], 3);
}

TEST_F(Loop, ThePathBeforeItIsExecutedToItsEnd) {
  load("G90\nG1 X10 F6000\nX12\nN5 GOTO 5\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run_into_loop(5);
  EXPECT_EQ(drive.rows.back()[0], 12);
  EXPECT_EQ(core->run_state(), RunState::RUNNING);
  EXPECT_EQ(core->state().detail, "line 4: 60,000 lines were read without a motion; reset ends it");
  ask(CommandKind::RESET);
  round();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
}

TEST_F(Loop, OfMovesToWhereTheAxesAreItIsOneToo) {
  load("G90\nG1 X10 F6000\nN5 G1 X10\nGOTO 5\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run_into_loop(0);
  EXPECT_EQ(drive.rows.back()[0], 10);
}

TEST_F(Loop, IsHeldAndGoesOnAtCycleStart) {
  load("N5 GOTO 5\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run_into_loop(1);
  ASSERT_TRUE(ask(CommandKind::FEED_HOLD).accepted);
  round();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_FALSE(core->loops());
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run_into_loop(1);
  EXPECT_EQ(core->run_state(), RunState::RUNNING);
}

TEST_F(Loop, TheSearchForALineBehindItEndsByReset) {
  load("G90\nN5 GOTO 5\nG1 X10 F6000\nM30\n");
  ASSERT_TRUE(ask(CommandKind::START_FROM_LINE, "", 3).accepted);
  run_into_loop(1);
  EXPECT_EQ(core->state().detail, "line 2: 28,000 lines were read without a motion; reset ends it");
  ask(CommandKind::RESET);
  round();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
}

TEST_F(Loop, ALongCalculationEndsAndThePathDoesNotDependOnHowFastItIsRead) {
  const std::string program =
      "G90\nG1 X10 F6000\n#1=0\nWHILE [#1 LT 60000] DO1\n#1=#1+1\nEND1\nG1 X20\nX30\nM30\n";
  std::vector<std::vector<double>> first;
  for (const int reads : {1, 7}) {
    drive.rows.clear();
    load(program);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    for (int i = 0; i < 10000 && core->run_state() != RunState::IDLE; ++i) {
      round();
      for (int k = 0; k < reads; ++k) core->read_on();
    }
    ASSERT_EQ(core->run_state(), RunState::IDLE);
    ASSERT_EQ(drive.rows.back()[0], 30);
    if (first.empty())
      first = drive.rows;
    else
      EXPECT_EQ(drive.rows, first);
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
    ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G0 X0").accepted);
    run();
  }
}

TEST_F(Loop, ASubprogramWhoseTextIsOnItsWayIsNone) {
  subprograms["O1007.nc"] = {"N5 GOTO 5\nM99\n"};
  load("M98 P1007\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  core->advance();
  EXPECT_TRUE(core->waits_for_text());
  EXPECT_FALSE(core->loops());
  run_into_loop(1);
  EXPECT_EQ(core->state().detail, "line 1: 28,000 lines were read without a motion; reset ends it");
}

}  // namespace
}  // namespace trunnion::channel
