// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using testing::Channel;
using testing::Codes;
using enum idl::channel::AuxiliaryKind;
using testing::FakeDrive;
using testing::three_axes;

TEST_F(Channel, RunsAProgramToItsEndAndLandsOnTheLastPointBitForBit) {
  load("G90 G21 G54\nG0 X10.1 Y5\nG1 X-3.7 F2000\nG2 X-3.7 Y5 I10 J0\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_FALSE(drive.rows.empty());
  EXPECT_EQ(drive.rows.back()[0], -3.7);
  EXPECT_EQ(drive.rows.back()[1], 5);
  EXPECT_TRUE(events.empty()) << events[0].text;
}

TEST_F(Channel, TheTrajectoryDoesNotDependOnWhenBatchesAreExecuted) {
  const std::string program = "G90\nG1 X20 Y3 F3000\nX40 Y-3\nG3 X60 Y-3 R15\nG4 X0.05\nG0 Z10\nM30\n";
  load(program);
  ask(CommandKind::CYCLE_START);
  run();
  const auto whole = drive.rows;
  drive = FakeDrive(3);
  begin();
  load(program);
  cycles_per_round = 1;
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(drive.rows, whole);
}

TEST_F(Channel, HoldStopsOnThePathAndCycleStartContinues) {
  load("G90\nG1 X100 Y50 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ASSERT_TRUE(ask(CommandKind::FEED_HOLD).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_GT(drive.rows.back()[0], 0);
  EXPECT_LT(drive.rows.back()[0], 100);
  EXPECT_NEAR(drive.rows.back()[1], drive.rows.back()[0] / 2, 1e-9);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 100);
}

TEST_F(Channel, ResetWhileMovingBrakesOnThePathAndForgetsTheRest) {
  load("G90\nG1 X100 Y50 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_LT(drive.rows.back()[0], 100);
  double fastest = 0;
  for (std::size_t i = 1; i < drive.rows.size(); ++i)
    fastest = std::max(fastest, std::abs(drive.rows[i][0] - drive.rows[i - 1][0]));
  EXPECT_LT(std::abs(drive.rows.back()[0] - drive.rows[drive.rows.size() - 2][0]), fastest / 20);
}

TEST_F(Channel, SingleBlockStopsAfterEveryBlock) {
  load("G90\nG1 X10 F3000\nX20\nX30\nM30\n");
  ask(CommandKind::SINGLE_BLOCK, "", 1);
  std::vector<double> stops;
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
    if (core->run_state() == RunState::IDLE) break;
    stops.push_back(drive.rows.back()[0]);
  }
  EXPECT_EQ(stops, (std::vector<double>{10, 20, 30}));
}

TEST_F(Channel, MCodesGoToThePlcInOrderAndMotionWaitsForThem) {
  load("G90\nT1\nM6\nS1000 M3\nG1 X5 F1000\nM8\nM30\n");
  answer_plc = false;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 50; ++i) round();
  EXPECT_EQ(core->run_state(), RunState::WAITING);
  EXPECT_EQ(drive.rows.size(), 0u) << "nothing moves while the PLC has not answered";
  for (int i = 0; i < 10 && core->run_state() == RunState::WAITING; ++i) {
    core->on_auxiliary_done({0, auxiliaries.back().number + 1, false});
    EXPECT_EQ(core->run_state(), RunState::WAITING) << "only the number asked for counts";
    core->on_auxiliary_done({0, auxiliaries.back().number, false});
    for (int k = 0; k < 2000 && core->run_state() == RunState::RUNNING; ++k) round();
  }
  Codes kinds;
  for (const auto& a : auxiliaries) kinds.emplace_back(a.kind, a.code);
  EXPECT_EQ(kinds, (Codes{{T, 1}, {M, 6}, {S, 0}, {M, 3}, {M, 8}, {M, 30}}));
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(core->state().tool, 1u);
}

TEST_F(Channel, AMoveBeyondTheTravelIsAnAlarmBeforeItMoves) {
  load("G90\nG1 X10 F3000\nX401\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "part.nc:3: X would go to 401.0000, its travel is -400.0000 .. 400.0000");
  EXPECT_EQ(drive.rows.back()[0], 10);
}

TEST_F(Channel, ASyntaxErrorIsReportedWithItsPlaceAndWhatIsBeforeItRuns) {
  load("G90\nG1 X10 F3000\nG77 X3\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::unknown_g);
  EXPECT_EQ(events[0].text.substr(0, 12), "part.nc:3:1:");
  EXPECT_EQ(drive.rows.back()[0], 10);
}

TEST_F(Channel, AHoldOfTheDriveInterruptsAndCycleStartResumesTheSameStream) {
  load("G90\nG1 X100 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  drive.mode = DriveMode::HELD;
  round();
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.resumes, 1);
  EXPECT_EQ(drive.starts, 1) << "it is the same stream";
}

TEST_F(Channel, AFreshProcessContinuesWhereTheKilledOneWas) {
  load("G90\nG1 X30 Y10 F6000\nG2 X30 Y10 I20 J0\nG1 X60 Y0\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  const auto undisturbed = drive.rows;
  // The points of the path the undisturbed run went through; the interrupted one must stay on them.
  const auto distance_to_path = [&](const std::vector<double>& p) {
    double best = 1e9;
    for (std::size_t i = 1; i < undisturbed.size(); ++i) {
      const auto &a = undisturbed[i - 1], &b = undisturbed[i];
      const double dx = b[0] - a[0], dy = b[1] - a[1], l = dx * dx + dy * dy;
      const double t = l > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / l, 0.0, 1.0) : 0;
      best = std::min(best, std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy));
    }
    return best;
  };
  for (const int kill_after : {30, 80, 130}) {
    drive = FakeDrive(3);
    cycles_per_round = 8;
    begin();
    load(text);
    ask(CommandKind::CYCLE_START);
    for (int i = 0; i < kill_after; ++i) round();
    const double x = drive.rows.back()[0];
    drive.lose_queue();
    drive.mode = DriveMode::HELD;
    begin();  // the process is killed and started again
    EXPECT_EQ(core->run_state(), RunState::INTERRUPTED) << "after " << kill_after;
    EXPECT_EQ(core->state().program, "part.nc");
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    const auto before = drive.rows.size();
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    ASSERT_GT(drive.rows.size(), before);
    EXPECT_NEAR(drive.rows[before][0], x, 0.5);
    EXPECT_EQ(drive.rows.back()[0], 60);
    for (const auto& row : drive.rows)
      ASSERT_LT(distance_to_path(row), 0.02) << "0.01 contour tolerance of either run";
  }
}

TEST_F(Channel, ARestartedDriveIsNoticedAndTheProgramContinuesFromTheCut) {
  load("G90\nG1 X100 F6000\nM30\n");
  start_and_go_on_after_a_restart_of_the_drive();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 100);
}

TEST_F(Channel, ADriveThatWasRestartedWhileTheProgramWasHeldTakesItAgainWithTheFirstCycleStart) {
  load("G90\nG1 X100 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ask(CommandKind::FEED_HOLD);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  for (int life = 0; life < 3; ++life) {
    drive.forget();
    drive.mode = DriveMode::OFF;  // its drives are off until the PLC's enables have arrived
    auto first_word = drive.run(0);
    first_word.applied = {{idl::stream::Input::PARAMETER_SET, 0, 1}};
    core->on_feedback(first_word);
    drive.mode = DriveMode::FOLLOWING;
    core->on_feedback(drive.run(0));
    ASSERT_EQ(core->run_state(), RunState::HELD) << life;
  }
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 100);
}

TEST_F(Channel, DrivesThatWereOffWhileTheProgramWasHeldMakeItBeginAgain) {
  load("G90\nG1 X100 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ask(CommandKind::FEED_HOLD);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  drive.mode = DriveMode::OFF;
  core->on_feedback(drive.run(0));
  drive.mode = DriveMode::FOLLOWING;
  core->on_feedback(drive.run(0));
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  EXPECT_FALSE(ask(CommandKind::CYCLE_START).accepted) << "the spindle may have stopped";
  ask(CommandKind::RESET);
  EXPECT_FALSE(ask(CommandKind::CYCLE_START).accepted) << "its line is offered";
  ask(CommandKind::RESET);
  EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
}

TEST_F(Channel, AnMdiLineRunsAndKeepsItsModalStateForTheNext) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G91 G1 X5 F2000").accepted);
  run();
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "X5").accepted);
  run();
  EXPECT_NEAR(drive.rows.back()[0], 10, 1e-12);
  const auto answer = ask(CommandKind::MDI_LINE, "G1 Q5");
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.reason.substr(0, 8), "MDI:1:4:") << answer.reason;
}

TEST_F(Channel, AnMdiLineWithASpeedAboveTheHighestOfTheSpindleIsRefused) {
  parameters->values[105000].text = "S";
  parameters->values[105001].value = 10;  // a spindle
  parameters->values[105948].value = 4000;
  begin();
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  const auto answer = ask(CommandKind::MDI_LINE, "M3 S4001");
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.alarm, 1126u);
  EXPECT_EQ(answer.reason,
            "MDI:1:4: speed above the highest of the spindle: S4001, at most 4000 1/min (10a948)");
  EXPECT_EQ(core->state().spindle_programmed, 0);
  EXPECT_TRUE(ask(CommandKind::MDI_LINE, "M3 S4000").accepted);
  run();
  EXPECT_EQ(core->state().spindle_programmed, 4000);
}

/// MDI lines one after the other, and where X and Y are behind each.
struct MdiLines : Channel {
  std::vector<std::pair<double, double>> after(const std::vector<std::string>& lines) {
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
    std::vector<std::pair<double, double>> places;
    for (const auto& line : lines) {
      const auto answer = ask(CommandKind::MDI_LINE, line);
      EXPECT_TRUE(answer.accepted) << line << ": " << answer.reason;
      run();
      places.emplace_back(drive.rows.empty() ? 0 : drive.rows.back()[0],
                          drive.rows.empty() ? 0 : drive.rows.back()[1]);
    }
    return places;
  }
};

TEST_F(MdiLines, ContinueInTheFramesOfTheLinesBefore) {
  const auto places = after({"G90 G52 X10", "G0 X5", "G52 X0", "X5", "G92 X0", "X1", "G92.1", "X1"});
  // 10 + 5; without G52 5; G92 calls that 0, so 1 is 6; without G92 1.
  EXPECT_EQ(places[1].first, 15);
  EXPECT_EQ(places[3].first, 5);
  EXPECT_EQ(places[5].first, 6);
  EXPECT_EQ(places[7].first, 1);
}

TEST_F(MdiLines, ContinueInRotationScalingMirrorAndPolarCoordinates) {
  const auto places = after({"G90 G68 X0 Y0 R90", "G0 X2 Y0", "G69", "G51 X0 Y0 P3", "X2 Y1", "G50",
                             "G51.1 X0", "X2 Y1", "G50.1", "G16", "X4 Y90", "G15"});
  EXPECT_NEAR(places[1].first, 0, 1e-12);
  EXPECT_NEAR(places[1].second, 2, 1e-12);
  EXPECT_EQ(places[4], (std::pair<double, double>{6, 3}));
  EXPECT_EQ(places[7], (std::pair<double, double>{-2, 1}));
  EXPECT_NEAR(places[10].first, 0, 1e-12);
  EXPECT_NEAR(places[10].second, 4, 1e-12);
}

TEST_F(MdiLines, AResetAndAProgramEndTheFramesOfTheLines) {
  after({"G90 G52 X10"});
  ask(CommandKind::RESET);
  EXPECT_EQ(after({"G90 G0 X5"}).back().first, 5);
  after({"G52 X50"});
  cycles_per_round = 8;
  ask(CommandKind::MDI_LINE, "G1 X100 F6000");
  for (int i = 0; i < 20; ++i) round();
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(after({"G90 G0 X5"}).back().first, 5) << "also a reset while a line moves";
  after({"G52 X10", "G68 X0 Y0 R90"});
  load("G90 G0 X7 Y3\nG52 X100\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(drive.rows.back()[0], 7) << "a program means the same whatever was typed before";
  EXPECT_EQ(after({"G90 G0 X6"}).back().first, 6) << "and leaves no frame behind";
}

TEST_F(Channel, MacroVariablesGoFromLineToProgramToProgram) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "#500=5").accepted);
  run();
  load("G90\n#500=#500+1\nG1 X#500 F6000\nM30\n");
  for (const double x : {6, 7}) {
    ask(CommandKind::CYCLE_START);
    run();
    EXPECT_EQ(drive.rows.back()[0], x);
  }
}

TEST_F(Channel, ARestartInterpretsTheProgramWithTheVariablesItBeganWith) {
  load("G90\n#100=#100+1\nG1 X[#100*60] F6000\nY[#100]\nM30\n");
  start_and_go_on_after_a_restart_of_the_drive();
  EXPECT_EQ(drive.rows.back()[0], 60);
  EXPECT_EQ(drive.rows.back()[1], 1);
}

TEST_F(Channel, RequestsThatMakeNoSenseAreRefusedWithAReason) {
  EXPECT_NE(ask(CommandKind::SELECT_PROGRAM, "none.nc").reason.find("none.nc"), std::string::npos);
  EXPECT_FALSE(ask(CommandKind::CYCLE_START).accepted) << "mode JOG";
  EXPECT_FALSE(ask(CommandKind::MDI_LINE, "G0 X1").accepted);
  EXPECT_EQ(ask(CommandKind::FEED_OVERRIDE, "", 1.6).reason, "value 1.6 must be from 0 to 1.5");
  EXPECT_FALSE(ask(CommandKind::FEED_OVERRIDE, "", std::nan("")).accepted);
  core->set_ready(false);
  ask(CommandKind::SET_MODE);
  EXPECT_EQ(ask(CommandKind::CYCLE_START).reason, "The cluster is not ready: see the services");
}

TEST_F(Channel, AParameterRevisionIsUsedFromTheNextMotionOnNeverWithinOne) {
  load("G90\nG1 X100 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 10; ++i) round();
  core->set_parameters(three_axes(2));
  EXPECT_EQ(core->machine().revision(), 1u);
  run();
  EXPECT_EQ(core->machine().revision(), 2u);
}

TEST_F(Channel, AnAlarmThatHoldsStopsTheMotionAndCycleStartIsRefusedUntilItIsGone) {
  load("G90\nG1 X100 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  core->set_hold("Alarm 100: Service plc was ended by signal 9");
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_FALSE(ask(CommandKind::CYCLE_START).accepted);
  core->set_hold("");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(drive.rows.back()[0], 100);
}

TEST_F(Channel, KeptVariablesGoFromOneProgramToTheNext) {
  load("#500=12.5\n#1=3\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  const auto* variables = core->take_variables();
  ASSERT_NE(variables, nullptr);
  EXPECT_EQ(variables->kept[0].number, 12.5);
  EXPECT_EQ(core->take_variables(), nullptr) << "reported once";
  load("G90 G1 X#500 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(drive.rows.back()[0], 12.5);
}

TEST_F(Channel, AMotionStartsOnlyWhenTheCopiesOfEveryStageAreInStep) {
  load("G90\nG1 X100 Y50 F6000\nM30\n");
  core->set_replicas(false, ~0ull);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 20; ++i) round();
  EXPECT_EQ(drive.starts, 0);
  EXPECT_EQ(core->run_state(), RunState::RUNNING) << "it waits";
  core->set_replicas(true, ~0ull);
  run();
  EXPECT_EQ(drive.starts, 1);
  EXPECT_EQ(drive.rows.back()[0], 100);
}

TEST_F(Channel, NothingIsWrittenFartherThanTwoLeadsBeyondTheSlowestCopy) {
  load("G90\nG1 X100 Y50 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  load("G90\nG1 X0 Y0 F6000\nM30\n");
  const auto begin = drive.next;
  core->set_replicas(true, 0);  // as of a replica that has received nothing of this motion
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 50; ++i) round();
  // Parameter 000900: the lead is 32 cycles. Two of them are allowed, batch by batch of 16.
  EXPECT_EQ(drive.next - begin, 64u);
  core->set_replicas(true, begin + 10);
  for (int i = 0; i < 50; ++i) round();
  EXPECT_EQ(drive.next - begin, 64u) << "74 cycles do not hold another whole batch of 16";
  core->set_replicas(true, begin + 16);
  for (int i = 0; i < 50; ++i) round();
  EXPECT_EQ(drive.next - begin, 80u);
  core->set_replicas(true, ~0ull);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 0);
}

TEST_F(Channel, HandsOverAtRestAndTheNextProcessHasTheSameStateAndProgram) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G91 G20 G55 F77").accepted);
  run();
  load("G90\nG1 X100 Y50 F6000\nM30\n");
  ask(CommandKind::FEED_OVERRIDE, "", 0.5);
  ask(CommandKind::SINGLE_BLOCK, "", 1);
  ask(CommandKind::DRY_RUN, "", 1), ask(CommandKind::AUXILIARY_LOCK, "", 1),
      ask(CommandKind::BLOCK_SKIP, "", 5);
  const auto before = core->state();
  const auto left = core->hand_over();
  ASSERT_TRUE(left);
  core = std::make_unique<ChannelCore>(0, true);
  core->set_parameters(three_axes());
  core->set_tools({});
  core->set_offsets({});
  store();
  core->on_feedback(drive.run(0));
  core->take_over(*left);
  core->recover();
  const auto after = core->state();
  EXPECT_EQ(after.modal, before.modal);
  EXPECT_EQ(after.program, "part.nc");
  EXPECT_EQ(after.mode, before.mode);
  EXPECT_EQ(after.feed_override, 0.5);
  EXPECT_TRUE(after.single_block && after.dry_run && after.auxiliary_lock);
  EXPECT_EQ(after.block_skip, 5);
  EXPECT_EQ(after.work_offset, before.work_offset);
  EXPECT_EQ(after.reset_count, before.reset_count);

  core->set_ready(true);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  round();
  EXPECT_FALSE(core->hand_over()) << "a channel that moves leaves nothing: the drive's cut has it";
}

}  // namespace
}  // namespace trunnion::channel
