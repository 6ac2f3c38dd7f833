// SPDX-License-Identifier: Apache-2.0
// Parameter 010166: an exact stop lasts until the axes are in position, at most that long.
#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;

struct ExactStop : Channel {
  static constexpr std::uint64_t lead = 32;  // parameter 000900

  /// `time` in ms.
  void begin_with(double time) {
    parameters = testing::three_axes(2);
    parameters->values[10166] = {time, ""};
    begin();
  }
  /// Cycles in which X was commanded to `x`.
  std::size_t cycles_at(double x) const {
    return static_cast<std::size_t>(
        std::count_if(drive.rows.begin(), drive.rows.end(), [&](const auto& row) { return row[0] == x; }));
  }
  void run_program(const std::string& program) {
    load(program);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    for (int i = 0; i < 2000 && core->run_state() != idl::channel::RunState::IDLE; ++i) round();
  }
  using CommandKind = idl::channel::CommandKind;
};

const char* const two_moves = "G21 G90\nG9 G1 X10 F3000\nG1 X20\nM30\n";

TEST_F(ExactStop, IsNotCheckedWithoutATime) {
  begin_with(0);
  run_program(two_moves);
  EXPECT_LE(cycles_at(10), 3u);
}

TEST_F(ExactStop, LastsTheLeadWhenTheAxesFollowWithoutError) {
  begin_with(1000);
  run_program(two_moves);
  EXPECT_EQ(core->run_state(), idl::channel::RunState::IDLE);
  // The following error of the first cycle at the stop is known one lead and one cycle later.
  EXPECT_GE(cycles_at(10), lead + 1);
  EXPECT_LE(cycles_at(10), lead + 4);
}

TEST_F(ExactStop, LastsUntilTheFollowingErrorIsInsideTheWindow) {
  begin_with(1000);
  drive.lag = [&](std::uint64_t, const std::vector<double>& row) {  // 0.02 mm until 200 cycles at the stop
    return row[0] == 10 && cycles_at(10) < 200 ? 0.02 : 0.0;
  };
  run_program(two_moves);
  EXPECT_EQ(core->run_state(), idl::channel::RunState::IDLE);
  EXPECT_GE(cycles_at(10), 200 + lead);
  EXPECT_LE(cycles_at(10), 200 + lead + 20);
}

TEST_F(ExactStop, EndsInAnAlarmWhenItIsNotReachedInTimeAndCanBeContinued) {
  begin_with(100);
  bool behind = true;
  drive.lag = [&](std::uint64_t, const std::vector<double>& row) {
    return row[0] == 10 && behind ? 0.02 : 0.0;
  };
  load(two_moves);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 2000 && core->run_state() != idl::channel::RunState::HELD; ++i) round();
  ASSERT_EQ(core->run_state(), idl::channel::RunState::HELD);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::position_not_reached);
  EXPECT_NE(
      events.back().text.find("axis 0 is 0.02 mm from its exact stop, window 0.01 mm (parameter 100911)"),
      std::string::npos)
      << events.back().text;
  EXPECT_EQ(drive.rows.back()[0], 10) << "it does not move on";
  behind = false;
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 2000 && core->run_state() != idl::channel::RunState::IDLE; ++i) round();
  EXPECT_EQ(drive.rows.back()[0], 20);
}

TEST_F(ExactStop, AResetAtTheStopEndsTheProgramWithoutTheAlarm) {
  begin_with(100);
  drive.lag = [](std::uint64_t, const std::vector<double>& row) { return row[0] == 10 ? 0.02 : 0.0; };
  load(two_moves);
  cycles_per_round = 8;
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 2000 && cycles_at(10) < lead; ++i) round();
  ASSERT_EQ(core->states().name(), "Running program");
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), idl::channel::RunState::IDLE);
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(drive.rows.back()[0], 10);
}

// The drive stops at every time of the check; setpoints that follow the interruption are written in it.
TEST_F(ExactStop, IsNotPassedWhileTheDriveHasInterruptedTheProgram) {
  std::size_t failed = 0;
  for (std::size_t stopped_after = 1; stopped_after < 160; stopped_after += 16) {
    drive = testing::FakeDrive{3};
    events.clear();
    begin_with(100);
    bool behind = true;
    drive.lag = [&](std::uint64_t, const std::vector<double>& row) {
      return row[0] == 10 && behind ? 0.02 : 0.0;
    };
    load(two_moves);
    cycles_per_round = 8;
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    for (int i = 0; i < 2000 && cycles_at(10) < stopped_after; ++i) round();
    if (!core->states().in<Running>()) break;  // the alarm of the check has held it
    drive.mode = DriveMode::HELD;
    core->on_feedback(drive.run(0));
    for (int i = 0; i < 5; ++i) round();
    ASSERT_EQ(core->states().name(), "Interrupted program") << stopped_after;
    for (const auto& event : events) failed += event.alarm == &alarm::position_not_reached ? 1 : 0;
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run(3);
    EXPECT_EQ(drive.rows.back()[0], 10) << stopped_after;
    behind = false;
    if (core->states().in<Held>()) ask(CommandKind::CYCLE_START);
    run();
    if (core->states().in<Held>()) ask(CommandKind::CYCLE_START), run();
    EXPECT_EQ(core->run_state(), idl::channel::RunState::IDLE) << stopped_after;
    EXPECT_EQ(drive.rows.back()[0], 20) << stopped_after;
  }
  EXPECT_EQ(failed, 1u) << "once the time ended in the interruption";
}

}  // namespace
}  // namespace trunnion::channel
