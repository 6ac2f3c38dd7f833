// SPDX-License-Identifier: Apache-2.0
// Threads: the axes follow a spindle that turns by itself; what the operator may do.
#include <cmath>

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using testing::Channel;

struct ThreadCut : Channel {
  // S 600 is 0.01 revolutions in a cycle.
  void SetUp() override {
    parameters->values[105000] = {0, "S"}, parameters->values[105001] = {10, ""};
    drive.spindle_angle = [](std::uint64_t cycle) { return 0.3 + 0.01 * static_cast<double>(cycle); };
    cycles_per_round = 8;
    begin();
  }
  void start(const std::string& program) {
    load(program);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  }
  void cut_to(double z) {
    for (int i = 0; i < 100000 && (drive.rows.empty() || drive.rows.back()[2] > z); ++i) round();
  }
  double z() const { return drive.rows.back()[2]; }
  /// Setpoints that followed the spindle.
  std::vector<std::vector<double>> thread_rows() const {
    std::vector<std::vector<double>> result;
    for (std::size_t i = 0; i < drive.rows.size(); ++i)
      if (drive.follows[i]) result.push_back(drive.rows[i]);
    return result;
  }
  /// Rounds until the operator is told something.
  std::string told() {
    for (int i = 0; i < 1000 && core->state().detail.empty(); ++i) round();
    return core->state().detail;
  }
  bool marked = true;  // the index mark has passed
  bool has_event(const machine::AlarmDefinition& alarm) const {
    return std::any_of(events.begin(), events.end(), [&](const auto& e) { return e.alarm == &alarm; });
  }
};

const std::string one_thread = "G90 G94 G0 Z5\nG0 Z0\nS600 M3\nG33 Z-20 F2 Q90\nG0 X5\nM30\n";

TEST_F(ThreadCut, ThePitchLineGoesThroughTheStartPointAtTheStartAngle) {
  start(one_thread);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 5);
  EXPECT_EQ(z(), -20);
  int rows = 0;
  for (std::size_t i = 0; i < drive.rows.size(); ++i) {
    EXPECT_EQ(static_cast<bool>(drive.follows[i]), drive.spindle[i].has_value());
    const double depth = -drive.rows[i][2];
    if (!drive.spindle[i] || depth < 5 || depth > 15) continue;
    const double origin = *drive.spindle[i] - depth / 2;
    ASSERT_NEAR(origin - std::floor(origin), 0.25, 1e-7);
    ++rows;
  }
  EXPECT_NEAR(rows, 500, 2) << "10 mm are 5 revolutions";
}

TEST_F(ThreadCut, BlocksThatFollowEachOtherAreCutWithoutAStop) {
  start("G90 S600 M3\nG33 Z-10 F2\nX1 Z-22\nG0 X5\nM30\n");
  run();
  EXPECT_EQ(drive.rows.back()[0], 5);
  for (std::size_t i = 1; i < drive.rows.size(); ++i) {
    const double depth = -drive.rows[i][2];
    if (depth < 5 || depth > 17) continue;
    ASSERT_NEAR(depth + drive.rows[i - 1][2], 0.02, 1e-6) << "Z keeps its lead over the corner";
  }
}

TEST_F(ThreadCut, IsTheSameWhateverTheDriveReportsAtATime) {
  start(one_thread);
  run();
  const auto rows = drive.rows;
  const auto angles = drive.spindle_angle;
  drive = testing::FakeDrive(3);
  drive.spindle_angle = angles;
  cycles_per_round = ~0ull;
  begin();
  start(one_thread);
  run();
  EXPECT_EQ(drive.rows, rows);
}

// The axes follow the measured angle: of the override of the spindle they know only by that.
TEST_F(ThreadCut, AFeedHoldActsAtTheEndAndOverridesDoNot) {
  start(one_thread);
  run();
  const auto undisturbed = thread_rows();
  ASSERT_GT(undisturbed.size(), 1000u) << "20 mm are 10 revolutions of 100 cycles";
  const auto angles = drive.spindle_angle;
  drive = testing::FakeDrive(3);
  drive.spindle_angle = angles;
  begin();
  start(one_thread);
  cut_to(-5);
  ask(CommandKind::FEED_OVERRIDE, "", 0.1);
  ask(CommandKind::SPINDLE_OVERRIDE, "", 0.5);
  ASSERT_TRUE(ask(CommandKind::FEED_HOLD).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_EQ(z(), -20);
  EXPECT_EQ(thread_rows(), undisturbed);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 5);
}

TEST_F(ThreadCut, AResetLeavesTheThreadAlongThePitchLine) {
  start(one_thread);
  cut_to(-5);
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_LT(z(), -5);
  EXPECT_GT(z(), -12);
  EXPECT_EQ(drive.rows.back()[0], 0);
  // From there the axes go on as before.
  load("G90 G1 Z0 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(z(), 0);
}

TEST_F(ThreadCut, ASpindleThatDoesNotTurnBreaksItOffBeforeItBegins) {
  drive.spindle_angle = [](std::uint64_t) { return 0.3; };
  start(one_thread);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(z(), 0);
  EXPECT_TRUE(has_event(alarm::thread_broken));
}

TEST_F(ThreadCut, TheOperatorIsToldForWhatAThreadWaits) {
  drive.spindle_angle = [](std::uint64_t cycle) { return 0.004 * static_cast<double>(cycle); };
  start(one_thread);
  EXPECT_EQ(told(), "the thread waits for the spindle: it turns at 240 1/min, S is 600 1/min");
  ask(CommandKind::RESET);
  run();
  drive.spindle_angle = [](std::uint64_t cycle) { return 0.01 * static_cast<double>(cycle); };
  drive.spindle_states = [this](std::uint64_t) {
    std::vector<idl::stream::SpindleState> states(1);
    states[0].homed = marked, states[0].master = -1;
    return states;
  };
  marked = false;
  start(one_thread);
  EXPECT_EQ(told(), "the thread waits for the index mark of the spindle");
  EXPECT_EQ(z(), 0);
  marked = true;
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(z(), -20);
}

// M5 behind the thread has not been answered when the process is killed.
TEST_F(ThreadCut, AProgramGoesOnBehindAWholeThreadInAnotherProcess) {
  start("G90 G94 S600 M3\nG33 Z-20 F2\nM5\nG0 X5\nM30\n");
  cut_to(-5);
  answer_plc = false;
  for (int i = 0; i < 100000 && auxiliaries.back().code != 5; ++i) round();
  ASSERT_EQ(auxiliaries.back().code, 5u);
  EXPECT_FALSE(core->link().snapshot().in_thread);
  answer_plc = true;
  events.clear();
  begin(core->running_program());
  round();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().text, "Program part.nc was interrupted in line 2");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_FALSE(has_event(alarm::not_resumable));
  EXPECT_EQ(drive.rows.back()[0], 5);
  EXPECT_EQ(z(), -20);
}

TEST_F(ThreadCut, AStopOfTheDriveInTheThreadCanOnlyBeReset) {
  start(one_thread);
  cut_to(-5);
  drive.mode = DriveMode::HELD;
  round();
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  EXPECT_FALSE(ask(CommandKind::CYCLE_START).accepted);
  ask(CommandKind::RESET);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
}

TEST_F(ThreadCut, AfterTheStreamWasLostInTheThreadTheProgramCannotBeResumed) {
  start(one_thread);
  cut_to(-5);
  drive.forget();
  round();
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  const auto moved = drive.rows.size();
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(has_event(alarm::not_resumable));
  EXPECT_EQ(drive.rows.size(), moved) << "nothing moved again";
}

TEST_F(ThreadCut, InADryRunItIsALine) {
  ASSERT_TRUE(ask(CommandKind::DRY_RUN, "", 1).accepted);
  start(one_thread);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(z(), -20);
  for (const auto& angle : drive.spindle) EXPECT_FALSE(angle);
}

TEST_F(ThreadCut, AThreadWithoutRoomForItsRunInIsRefusedBeforeItBegins) {
  start("G90 S600 M3\nG33 Z-0.1 F2\nM30\n");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(has_event(alarm::thread_too_short));
  EXPECT_TRUE(drive.rows.empty());
}

TEST_F(ThreadCut, TheSnapshotSaysThatAThreadIsCut) {
  start(one_thread);
  cut_to(-5);
  const auto& snapshot = core->link().snapshot();
  EXPECT_TRUE(snapshot.in_thread);
  EXPECT_NEAR(snapshot.thread_origin - std::floor(snapshot.thread_origin), 0.25, 1e-9);
  EXPECT_LT(snapshot.position[2], -4);
  run();
  EXPECT_FALSE(core->link().snapshot().in_thread);
}

}  // namespace
}  // namespace trunnion::channel
