// SPDX-License-Identifier: Apache-2.0
// A held program that is left for MDI and jog, and the return to it.
#include <cmath>

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::CommandKind;

struct Suspension : Channel {
  void run_into_a_hold(const std::string& program, int rounds = 40) {
    load(program);
    cycles_per_round = 8;
    ask(CommandKind::CYCLE_START);
    for (int i = 0; i < rounds; ++i) round();
    ask(CommandKind::FEED_HOLD);
    run();
    ASSERT_EQ(core->run_state(), RunState::HELD);
  }
  void mdi(const std::string& line) {
    ASSERT_TRUE(ask(CommandKind::MDI_LINE, line).accepted);
    for (int i = 0; i < 100000; ++i) {
      round();
      if (core->run_state() == RunState::HELD) break;
    }
  }
};
const std::string straight = "G90\nS800 M3\nM8\nG1 X100 Y50 F6000\nX0\nM30\n";

TEST_F(Suspension, JogAwayAndCycleStartReturnsToThePointAndContinues) {
  run_into_a_hold(straight);
  const auto left = drive.rows.back();
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG).accepted);
  EXPECT_TRUE(core->state().suspended);
  ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", 3000, 20, Mode::AUTO, 2).accepted);
  run();
  EXPECT_NEAR(drive.rows.back()[2], 20, 1e-9);
  EXPECT_FALSE(ask(CommandKind::CYCLE_START).accepted) << "mode JOG";
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::AUTO).accepted);
  const auto back_from = drive.rows.size();
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 0);
  EXPECT_EQ(drive.rows.back()[1], 50);
  // It is at rest at the point where it was left before the path continues.
  std::size_t at_point = 0;
  for (std::size_t i = back_from; i < drive.rows.size() && at_point == 0; ++i)
    if (drive.rows[i][0] == left[0] && drive.rows[i][1] == left[1] && drive.rows[i][2] == left[2])
      at_point = i;
  ASSERT_GT(at_point, 0u);
  for (std::size_t i = at_point; i < drive.rows.size(); ++i)
    if (drive.lines[i] == 4) {
      ASSERT_NEAR(drive.rows[i][1], drive.rows[i][0] / 2, 1e-9);
    }
}

TEST_F(Suspension, MdiInBetweenChangesNeitherTheModesNorTheVariablesOfTheProgram) {
  run_into_a_hold("G90\n#100=3\nG1 X100 F6000\nX[#100]\nM30\n");
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  mdi("#100=50");
  mdi("G91 G1 Z5 F3000");
  mdi("Z5");
  EXPECT_NEAR(drive.rows.back()[2], 10, 1e-9) << "its own modes are kept from line to line";
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::AUTO);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(drive.rows.back()[0], 3);
  EXPECT_EQ(drive.rows.back()[2], 0);
}

TEST_F(Suspension, FunctionsThatMdiChangedAreGivenAgainBeforeTheProgramMoves) {
  run_into_a_hold(straight);
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  mdi("M5");
  mdi("S100");
  auxiliaries.clear();
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::AUTO);
  const auto rows = drive.rows.size();
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  answer_plc = false;
  round();
  ASSERT_EQ(auxiliaries.size(), 1u);
  EXPECT_EQ(auxiliaries[0].value, 800);
  EXPECT_EQ(drive.rows.size(), rows) << "it waits";
  core->on_auxiliary_done({0, auxiliaries[0].number, false});
  answer_plc = true;
  run();
  ASSERT_EQ(auxiliaries.size(), 3u);
  EXPECT_EQ(auxiliaries[1].code, 3u);
  EXPECT_EQ(auxiliaries[2].code, 30u);
}

TEST_F(Suspension, AnotherToolInTheSpindleKeepsTheProgramFromGoingOn) {
  run_into_a_hold(straight);
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  mdi("T1 M6");
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::AUTO);
  const auto answer = ask(CommandKind::CYCLE_START);
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.reason, "The program was left with tool T0, T1 is in the spindle");
}

TEST_F(Suspension, ResetGivesTheProgramUp) {
  run_into_a_hold(straight);
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  ask(CommandKind::RESET);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_FALSE(core->state().suspended);
}

TEST_F(Suspension, AKilledChannelStillKnowsTheProgramThatWasLeft) {
  run_into_a_hold(straight);
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  ask(CommandKind::JOG_AXIS, "", 3000, 20, Mode::AUTO, 2);
  run();
  begin();
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  EXPECT_EQ(core->state().line, 4u);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 0);
  for (std::size_t i = 1; i < drive.rows.size(); ++i)
    ASSERT_LT(std::abs(drive.rows[i][2] - drive.rows[i - 1][2]), 0.5) << "no jump";
}

TEST_F(Channel, TheLineInWhichTheControlWasSwitchedOffIsOffered) {
  text = "G90\nG1 X10 F6000\nX20\nX30\nM30\n";
  core = std::make_unique<ChannelCore>(0, true);
  core->set_parameters(testing::three_axes());
  core->set_tools({});
  core->set_offsets({});
  core->set_ready(true);
  core->set_interrupted({{"part.nc", 3, 77, 3}});
  store();
  core->on_feedback(drive.run(0));
  core->recover();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(core->state().restart_line, 3u);
  EXPECT_EQ(core->running_program().line, 3u) << "it is not forgotten before it was used";
  round();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::switched_off_in_program);
  ask(CommandKind::SET_MODE);
  ASSERT_TRUE(ask(CommandKind::START_FROM_LINE, "", core->state().restart_line).accepted);
  run();
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(drive.rows.back()[0], 30);
  EXPECT_EQ(core->state().restart_line, 0u);
  EXPECT_EQ(core->running_program().line, 0u) << "no program is under way";
}

}  // namespace
}  // namespace trunnion::channel
