// SPDX-License-Identifier: Apache-2.0
// A command of `trunnion` that is killed leaves its temporary program behind, but not selected.
#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {
using namespace testing;

struct TemporaryProgram : Channel {
  void SetUp() override {
    Channel::SetUp();
    text = "G0 X10\nX20\nM30\n";
    idl::program::ProgramList list;
    for (const char* name : {"part.nc", "servo-test.tmp.nc", "calibration_pose.tmp.nc"})
      list.programs.push_back({name, 3, text.size(), 77, 3, 1});
    core->set_programs(list);
    ask(CommandKind::SET_MODE);
    ask(CommandKind::SELECT_PROGRAM, "part.nc");
  }
  std::string selected() { return core->state().program; }
};

TEST_F(TemporaryProgram, ThatHasEndedLeavesTheProgramOfBeforeSelected) {
  for (const char* name : {"servo-test.tmp.nc", "calibration_pose.tmp.nc"}) {
    ASSERT_TRUE(ask(CommandKind::SELECT_PROGRAM, name).accepted);
    EXPECT_EQ(selected(), name);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    EXPECT_EQ(selected(), "part.nc");
  }
}

TEST_F(TemporaryProgram, ThatWasHeldAndResetLeavesTheProgramOfBeforeSelected) {
  ask(CommandKind::SELECT_PROGRAM, "servo-test.tmp.nc");
  ask(CommandKind::SELECT_PROGRAM, "calibration_pose.tmp.nc");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 5; ++i) round();
  ask(CommandKind::FEED_HOLD);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_EQ(selected(), "calibration_pose.tmp.nc");
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(selected(), "part.nc");
}

TEST_F(TemporaryProgram, ThatWasNeverStartedGoesWithAReset) {
  ask(CommandKind::SELECT_PROGRAM, "servo-test.tmp.nc");
  ask(CommandKind::RESET);
  EXPECT_EQ(selected(), "part.nc");
}

TEST_F(TemporaryProgram, WithoutAProgramBeforeLeavesNone) {
  begin();
  idl::program::ProgramList list;
  list.programs.push_back({"servo-test.tmp.nc", 3, text.size(), 77, 3, 1});
  core->set_programs(list);
  ask(CommandKind::SET_MODE);
  ASSERT_TRUE(ask(CommandKind::SELECT_PROGRAM, "servo-test.tmp.nc").accepted);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(selected(), "");
}

}  // namespace
}  // namespace trunnion::channel
