// SPDX-License-Identifier: Apache-2.0
// What is left of a program, its variables and its path when the drive or the process stops in bad moments.
#include <cmath>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::CommandKind;

struct Recovery : Channel {
  void rounds(int count) {
    for (int i = 0; i < count; ++i) round();
  }
  void hold_a_program() {
    load("G90\nG1 X100 Y50 F6000\nX0\nM30\n");
    cycles_per_round = 8;
    ask(CommandKind::CYCLE_START);
    rounds(40);
    ask(CommandKind::FEED_HOLD);
    run();
    ASSERT_EQ(core->states().name(), "Held program");
  }
  void leave_it_and_jog_z() {
    hold_a_program();
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
    ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", 3000, 40, Mode::AUTO, 2).accepted);
  }
  void expect_no_jump() const {
    for (std::size_t i = 1; i < drive.rows.size(); ++i)
      for (std::size_t a = 0; a < 3; ++a)
        ASSERT_LT(std::abs(drive.rows[i][a] - drive.rows[i - 1][a]), 0.5) << "axis " << a << ", cycle " << i;
  }
};

TEST_F(Recovery, AResetBehindARestartOfTheProcessKeepsTheVariables) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  ask(CommandKind::MDI_LINE, "#500=12.5");
  run();
  const language::VariableStore kept = *core->take_variables();
  load("G1 X100 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  rounds(30);
  drive.lose_queue();
  drive.mode = DriveMode::HELD;
  begin();
  core->set_variables(kept);
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  ask(CommandKind::RESET);
  if (const auto* variables = core->take_variables()) {
    EXPECT_EQ(variables->kept[0].number, 12.5);
  }
  drive.mode = DriveMode::FOLLOWING;
  load("G90 G1 X#500 F6000\nM30\n");
  const auto answer = ask(CommandKind::CYCLE_START);
  ASSERT_TRUE(answer.accepted) << answer.reason;
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 12.5);
}

TEST_F(Recovery, AStopOfTheDriveInTheApproachOfARestartIsResumedWithoutAJump) {
  leave_it_and_jog_z();
  run();
  begin();  // the process was killed
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  rounds(12);
  ASSERT_EQ(core->states().name(), "Preparing");
  drive.mode = DriveMode::HELD;
  round();
  ASSERT_EQ(core->states().name(), "Interrupted preparing");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  EXPECT_EQ(core->states().name(), "Preparing");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 0);
  EXPECT_EQ(drive.resumes, 1);
  expect_no_jump();
}

TEST_F(Recovery, AProgramIsNotLeftBeforeItsRestartPointIsReached) {
  hold_a_program();
  begin();
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  ask(CommandKind::FEED_HOLD);
  core->advance();
  ASSERT_EQ(core->states().name(), "Held program");
  EXPECT_FALSE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG).accepted) << "a jog would shift its start";
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 0);
  expect_no_jump();
}

TEST_F(Recovery, AProgramThatWasLeftIsKnownToTheNextProcessAlsoWhenTheJogWasStopped) {
  leave_it_and_jog_z();
  rounds(20);
  ask(CommandKind::JOG_STOP);
  run();
  ASSERT_EQ(core->states().name(), "Suspended");
  begin();
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  expect_no_jump();
}

TEST_F(Recovery, AProgramThatWasResetAtRestIsNotContinuedByTheNextProcess) {
  hold_a_program();
  ask(CommandKind::RESET);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  // The drive's newest snapshot is still that of the held program.
  const auto kept = core->running_program();
  begin(kept);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  // The next program is resumed again, even when nothing newer was kept of it.
  load("G90\nG1 X100 Y50 F6000\nX0\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  rounds(40);
  EXPECT_EQ(core->running_program().ended, kept.ended);
  begin(kept);
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
}

TEST_F(Recovery, AProgramThatEndsWithFunctionsAtRestIsNotContinuedByTheNextProcess) {
  load("G90\nG1 X10 F6000\nM9\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  ASSERT_EQ(core->run_state(), RunState::IDLE);
  const auto kept = core->running_program();
  begin(kept);
  EXPECT_EQ(core->run_state(), RunState::IDLE) << "its last motion was in line 2, M9 and M30 come behind it";
  // Nor is it when the next program is killed before it has moved.
  load("G90\nM9\nG1 X30 F6000\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  const auto started = core->running_program();
  EXPECT_EQ(started.line, 1u);
  begin(started);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(core->state().restart_line, 1u) << "it is offered by its line";
}

TEST_F(Recovery, TheToolInTheSpindleIsKnownToTheNextProcessWhoeverPutItThere) {
  load("G90\nT1 M6\nG1 X10 F6000\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  ASSERT_EQ(core->state().tool, 1u);
  // Killed: the drive's snapshot has it, and the record may be older.
  begin({});
  EXPECT_EQ(core->state().tool, 1u);
  // Stated by hand, which no snapshot of the drive has.
  EXPECT_TRUE(ask({.command = CommandKind::TOOL_IN_SPINDLE, .tool = 12}).accepted);
  const auto kept = core->running_program();
  begin(kept);
  EXPECT_EQ(core->state().tool, 12u);
  // The cluster was down: the drive has no snapshot.
  drive = testing::FakeDrive(3);
  begin(kept);
  EXPECT_EQ(core->state().tool, 12u);
  load("G90\nG1 X10 F6000\nX0\nM30\n");
  ask(CommandKind::CYCLE_START);
  EXPECT_EQ(ask({.command = CommandKind::TOOL_IN_SPINDLE, .tool = 3}).reason, "The channel is busy");
}

TEST_F(Recovery, MdiFunctionsStillEndInAProgramUnderWhichTheDrivesWereSwitchedOff) {
  hold_a_program();
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  drive.mode = DriveMode::OFF;
  core->on_feedback(drive.run(0));
  drive.mode = DriveMode::FOLLOWING;
  core->on_feedback(drive.run(0));
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "M8").accepted);
  run();
  EXPECT_EQ(core->states().name(), "Suspended");
  ask(CommandKind::SET_MODE);
  EXPECT_EQ(ask(CommandKind::CYCLE_START).reason,
            "The drives were switched off in the program: reset the channel");
  ask(CommandKind::RESET);
  EXPECT_EQ(
      ask(CommandKind::CYCLE_START).reason,
      "part.nc was left in line 2: start from that line, or reset the channel to start the program from "
      "its beginning");
  ask(CommandKind::RESET);
  EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
}

TEST_F(Recovery, TheLineInWhichAnEmergencyStopLeftTheProgramIsOfferedBehindTheReset) {
  load("G90\nG1 X100 Y50 F6000\nX0\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  rounds(40);
  ASSERT_GT(core->state().feed, 0);
  drive.lose_queue();
  drive.mode = DriveMode::OFF;
  core->on_feedback(drive.run(0));
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  EXPECT_TRUE(core->state().needs_reset);
  EXPECT_EQ(core->state().feed, 0) << "the axes are at rest";
  drive.mode = DriveMode::FOLLOWING;
  core->on_feedback(drive.run(0));
  ask(CommandKind::RESET);
  run();
  EXPECT_FALSE(core->state().needs_reset);
  EXPECT_EQ(core->state().restart_line, 2u);
  ask(CommandKind::SET_MODE);
  ASSERT_TRUE(ask(CommandKind::START_FROM_LINE, "", 2).accepted);
  run();
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(drive.rows.back()[1], 50, 1e-9);
  EXPECT_EQ(core->state().restart_line, 0u);
  // A reset of its own accord offers nothing.
  ask(CommandKind::CYCLE_START);
  rounds(40);
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->state().restart_line, 0u);
}

TEST_F(Recovery, AJogInAHeldProgramDoesNotWaitForTheProgramsText) {
  std::string program = "G90\nG1 X10 F6000\n";
  while (program.size() < 3 * ProgramText::chunk_size) program += "G1 X10.5\nG1 X10\n";
  load(program + "M30\n");
  ask(CommandKind::CYCLE_START);
  core->advance();
  ASSERT_TRUE(core->waits_for_text());
  ask(CommandKind::FEED_HOLD);
  core->advance();
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", 3000, 5, Mode::AUTO, 2).accepted);
  EXPECT_FALSE(core->waits_for_text());
}

TEST_F(Recovery, AResetIsCompleteWhenTheDriveRestartsWhileItBrakes) {
  load("G90\nG1 X100 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  rounds(20);
  ask(CommandKind::RESET);
  ASSERT_EQ(core->states().name(), "Holding program, reset");
  drive.forget();
  round();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
}

TEST_F(Recovery, BehindMissingSetpointsCycleStartAloneContinuesThePathAndNothingElseStarts) {
  const std::string missing = "Alarm 110: No setpoint for cycle 200 in time";
  load("G90\nG1 X20 Y10 F6000\nX0\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  const auto undisturbed = std::exchange(drive.rows, {});
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  ask(CommandKind::MDI_LINE, "G0 Y0");
  run();
  drive.rows.clear();
  ask(CommandKind::SET_MODE);
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  rounds(20);
  // The alarm may come before the feedback that shows the stop, and ends when the drive goes on.
  core->set_drive_stopped(missing);
  EXPECT_EQ(core->run_state(), RunState::RUNNING) << "the drive stops the axes, not the channel";
  drive.mode = DriveMode::HELD;
  round();
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  EXPECT_EQ(core->state().detail, "the drive has stopped on the path: cycle start continues there");
  const auto answer = ask(CommandKind::CYCLE_START);
  ASSERT_TRUE(answer.accepted) << answer.reason;
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows, undisturbed);
  EXPECT_EQ(ask(CommandKind::CYCLE_START).reason, missing) << "of a stop that nothing has continued";
  core->set_drive_stopped("");
  EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
}

TEST_F(Recovery, BehindAStopOfTheDriveAChannelWaitsForTheOthersAndCanBeReset) {
  for (const bool reset : {false, true}) {
    load("G90\nG1 X20 F6000\nX0\nM30\n");
    cycles_per_round = 8;
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    rounds(20);
    drive.mode = DriveMode::HELD;
    round();
    drive.waits_for_others = true;
    const auto stood = drive.rows.size();
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    rounds(10);
    EXPECT_EQ(core->run_state(), RunState::RUNNING);
    EXPECT_EQ(core->state().detail,
              "the drive waits for cycle start, or a reset, of the other channels that it has stopped");
    EXPECT_EQ(drive.rows.size(), stood);
    drive.waits_for_others = false;
    if (reset)
      ask(CommandKind::RESET);
    else
      drive.mode = DriveMode::FOLLOWING;
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    EXPECT_EQ(drive.rows.size() == stood, reset);
    expect_no_jump();
  }
}

TEST_F(Recovery, BehindMissingSetpointsALineOfMdiContinuesToo) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  cycles_per_round = 8;
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G1 X20 F6000").accepted);
  rounds(10);
  core->set_drive_stopped("Alarm 110");
  drive.mode = DriveMode::HELD;
  round();
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 20);
  expect_no_jump();
}

TEST_F(Recovery, NothingStartsBeforeTheProcessKnowsWhatTheOneBeforeItLeft) {
  core = std::make_unique<ChannelCore>(0, true);
  core->set_parameters(parameters);
  core->set_ready(true);
  store();
  core->on_feedback(drive.run(0));
  EXPECT_EQ(ask(CommandKind::JOG_AXIS, "", 3000, 5).reason, "The drive has not answered yet");
  core->recover();
  EXPECT_TRUE(ask(CommandKind::JOG_AXIS, "", 3000, 5).accepted);
}

}  // namespace
}  // namespace trunnion::channel
