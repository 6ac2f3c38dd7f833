// SPDX-License-Identifier: Apache-2.0
// Rigid tapping: the spindle's angle and the depth are one, whatever the speed does; what the operator may
// do.
#include <cmath>

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using testing::Channel;
using testing::three_axes;

struct Tap : Channel {
  // A spindle that gains 2000 1/min in a second: 12000 deg/s2.
  void SetUp() override {
    parameters->values[105000] = {0, "S"}, parameters->values[105001] = {10, ""};
    parameters->values[105036] = {12000, ""};
    begin();
  }
  void start(const std::string& program) {
    load(program);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  }
  /// Rows in which the spindle was coupled, as (Z, revolutions).
  std::vector<std::pair<double, double>> coupled() const {
    std::vector<std::pair<double, double>> result;
    for (std::size_t i = 0; i < drive.rows.size(); ++i)
      if (drive.spindle[i]) result.emplace_back(drive.rows[i][2], *drive.spindle[i]);
    return result;
  }
  std::vector<int> m_codes() const {
    std::vector<int> codes;
    for (const auto& a : auxiliaries)
      if (a.kind == idl::channel::AuxiliaryKind::M) codes.push_back(static_cast<int>(a.code));
    return codes;
  }
};

// R 2, depth -10, lead 1.25: the hole is 12 mm, 9.6 turns.
const std::string hole = "G90 G94 G0 Z5\nS400 M3\nG99 G84 X0 Y0 Z-10 R2 F500\nG80\nG0 Z20\nM30\n";

TEST_F(Tap, DepthAndAngleKeepTheLeadInEveryCycleAndTheSpindleTurnsBackToWhereItBegan) {
  start(hole);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  const auto rows = coupled();
  ASSERT_GT(rows.size(), 1000u);
  double most = 0;
  for (const auto& [z, turns] : rows) {
    ASSERT_NEAR(2 - z, 1.25 * turns, 1e-9);
    most = std::max(most, turns);
  }
  EXPECT_NEAR(most, 9.6, 1e-9);
  EXPECT_NEAR(rows.back().second, 0, 1e-9);
  EXPECT_EQ(drive.rows.back()[2], 20);
}

TEST_F(Tap, TheSpindleIsNeverAskedForMoreThanItsSpeedAndItsAcceleration) {
  start(hole);
  run();
  const auto rows = coupled();
  for (std::size_t i = 2; i < rows.size(); ++i) {
    const double before = (rows[i - 1].second - rows[i - 2].second) * 60000;  // 1/min
    const double now = (rows[i].second - rows[i - 1].second) * 60000;
    ASSERT_LE(std::abs(now), 400 * (1 + 1e-6));
    ASSERT_LE(std::abs(now - before), 2 * (1 + 1e-3)) << "2000 1/min in a second are 2 in a cycle";
  }
}

TEST_F(Tap, ThePlcStopsTheSpindleBeforeAndStartsItAgainWhenTheCycleEnds) {
  start(hole);
  run();
  EXPECT_EQ(m_codes(), (std::vector<int>{3, 5, 3, 30}));
}

TEST_F(Tap, ALeftHandThreadTurnsInTheOtherDirection) {
  start("G90 G95 G0 Z5\nS400\nG99 G74 X0 Y0 Z-10 R2 F1.25\nG80\nM30\n");
  run();
  for (const auto& [z, turns] : coupled()) ASSERT_NEAR(2 - z, -1.25 * turns, 1e-9);
  EXPECT_EQ(m_codes(), (std::vector<int>{30}))
      << "the spindle was at rest, so it is neither stopped nor started";
}

TEST_F(Tap, TheFeedOverrideDoesNotActInTheThreadButElsewhere) {
  start(hole);
  run();
  const auto thread = coupled();
  const auto rows = drive.rows.size();
  drive = testing::FakeDrive(3);
  begin();
  load(hole);
  ask(CommandKind::FEED_OVERRIDE, "", 0.1);
  ask(CommandKind::RAPID_OVERRIDE, "", 0.02);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(coupled(), thread);
  EXPECT_GT(drive.rows.size(), rows);
}

/// The highest speed of the spindle in `rows` of coupled(), 1/min: a cycle is 1 ms.
double highest_speed(const std::vector<std::pair<double, double>>& rows) {
  double highest = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    highest = std::max(highest, std::abs(rows[i].second - rows[i - 1].second) * 60000);
  return highest;
}

TEST_F(Tap, TheSpindleOverrideActsOnBothAndTheyKeepTheLead) {
  for (const double override_ : {0.5, 1.25}) {
    drive = testing::FakeDrive(3);
    begin();
    load(hole);
    ask(CommandKind::SPINDLE_OVERRIDE, "", override_);
    ask(CommandKind::CYCLE_START);
    run();
    const auto rows = coupled();
    for (const auto& [z, turns] : rows) ASSERT_NEAR(2 - z, 1.25 * turns, 1e-9);
    EXPECT_NEAR(highest_speed(rows), 400 * override_, 0.01) << "S400";
    EXPECT_EQ(drive.rows.back()[2], 20);
  }
}

TEST_F(Tap, AChangeOfTheSpindleOverrideInTheThreadActsAtOnceWithinTheAccelerationOfTheSpindle) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -2) round();
  const auto before = coupled().size();
  ask(CommandKind::SPINDLE_OVERRIDE, "", 0.5);
  while (drive.rows.back()[2] > -8) round();
  const auto rows = coupled();
  const auto speed = [&](std::size_t i) { return (rows[i].second - rows[i - 1].second) * 60000; };
  EXPECT_NEAR(speed(before - 1), 400, 0.01);
  EXPECT_NEAR(speed(rows.size() - 1), 200, 0.01);
  for (std::size_t i = 2; i < rows.size(); ++i)
    ASSERT_LE(std::abs(speed(i) - speed(i - 1)), 2 * (1 + 1e-3)) << "2000 1/min in a second";
}

TEST_F(Tap, TheSpindleOverrideDoesNotTakeTheSpindleAboveItsHighestSpeed) {
  parameters->values[105948] = {450, ""};
  begin();
  load(hole);
  ask(CommandKind::SPINDLE_OVERRIDE, "", 1.5);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_NEAR(highest_speed(coupled()), 450, 0.01) << "and not 600";
}

TEST_F(Tap, ANumTapComesOutAtItsOwnSpeedAndTheSpindleTurnsAgainOrNot) {
  parameters->values[40959] = {1, ""};
  for (const bool stops : {false, true}) {
    auxiliaries.clear();
    drive = testing::FakeDrive(3);
    begin();
    // In at 200 1/min, out at 400; 12 mm at a lead of 1.25 mm are 9.6 turns.
    start(std::string("S200 M3\nG84 Z-10 K1.25 EK2 EH2 ER5") + (stops ? " M5" : "") + "\nG0 Z20\nM2\n");
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    const auto rows = coupled();
    ASSERT_FALSE(rows.empty());
    double in = 0, out = 0, most = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double speed = (rows[i].second - rows[i - 1].second) * 60000;
      in = std::max(in, speed), out = std::max(out, -speed), most = std::max(most, rows[i].second);
      ASSERT_NEAR(2 - rows[i].first, 1.25 * rows[i].second, 1e-9);
    }
    EXPECT_NEAR(in, 200, 0.01);
    EXPECT_NEAR(out, 400, 0.01);
    EXPECT_NEAR(most, 9.6, 1e-9);
    EXPECT_NEAR(rows.back().second, 0, 1e-9);
    EXPECT_EQ(drive.rows.back()[2], 20);
    EXPECT_EQ(m_codes(), (stops ? std::vector<int>{3, 5, 5, 2} : std::vector<int>{3, 5, 3, 2}));
  }
}

TEST_F(Tap, AFeedHoldActsOnlyWhenTheTapIsOutAgain) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  ASSERT_TRUE(ask(CommandKind::FEED_HOLD).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  EXPECT_EQ(drive.rows.back()[2], 2);
  EXPECT_NEAR(coupled().back().second, 0, 1e-9);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[2], 20);
}

TEST_F(Tap, AStopOfThePlcStopsSpindleAndAxisTogetherAndTheyContinueWhenItFalls) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  idl::plc::ChannelControl control;
  control.tap_stop = true;
  core->set_control(control);
  // From 8.33 mm/s with 41.7 mm/s2: 0.2 s and 0.8 mm, and what was written ahead.
  for (int i = 0; i < 200; ++i) round();
  auto rows = coupled();
  EXPECT_EQ(core->run_state(), RunState::RUNNING);
  EXPECT_EQ(core->state().detail,
            "the PLC has stopped the tap: it continues when the PLC lets it; reset leaves it where it is");
  EXPECT_EQ(rows.back(), rows[rows.size() - 100]);
  EXPECT_LT(rows.back().first, -5);
  EXPECT_GT(rows.back().first, -8);
  control.tap_stop = false;
  core->set_control(control);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[2], 20);
  rows = coupled();
  double most = 0;
  for (const auto& [z, turns] : rows) {
    ASSERT_NEAR(2 - z, 1.25 * turns, 1e-9);
    most = std::max(most, turns);
  }
  EXPECT_NEAR(most, 9.6, 1e-9);
}

TEST_F(Tap, AResetAbandonsATapThatThePlcHasStoppedAndOtherMovesAreNotStopped) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  idl::plc::ChannelControl control;
  control.tap_stop = true;
  core->set_control(control);
  for (int i = 0; i < 200; ++i) round();
  const auto stopped = drive.rows.back()[2];
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[2], stopped);
  start("G90 G0 Z20\nM30\n");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[2], 20);
}

// 12 mm at a lead of 1.25 mm are 9.6 turns, counter-clockwise out of a right-hand thread.
TEST_F(Tap, ATapThatAResetHasLeftIsMovedOutInStepWithTheSpindle) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  ask(CommandKind::RESET);
  run();
  const double from = drive.rows.back()[2];
  const auto before = coupled().size();
  start("S200 G84.9 Z12 K1.25\nM30\n");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(drive.rows.back()[2], from + 12, 1e-9);
  const auto rows = coupled();
  ASSERT_GT(rows.size(), before + 1000);
  for (std::size_t i = before; i < rows.size(); ++i)
    ASSERT_NEAR(from - rows[i].first, 1.25 * rows[i].second, 1e-9);
  EXPECT_NEAR(rows.back().second, -9.6, 1e-9);
}

// The hole is at X0 Y0 from Z2 down, its thread right-hand with lead 1.25.
TEST_F(Tap, ATapThatWasLeftComesOutOnlyAlongItsThreadAlsoInAnotherProcess) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  EXPECT_EQ(core->tap().lead, 1.25);
  ask(CommandKind::RESET);
  run();
  const double from = drive.rows.back()[2];
  begin(core->running_program());
  EXPECT_EQ(core->tap(), (program_execution::TapInHole{1.25, {0, 0, 2}, {0, 0, -1}}));
  const auto moved = drive.rows.size();
  for (const char* wrong : {"S200 G84.9 Z12 K-1.25\nM30\n", "S200 G84.9 Z12 K1.5\nM30\n",
                            "S200 G18 G84.9 Z-1 K1.25\nM30\n", "S200 G84.9 X5 K1.25\nM30\n"}) {
    events.clear();
    start(wrong);
    run();
    ASSERT_FALSE(events.empty()) << wrong;
    EXPECT_EQ(events.back().alarm, &alarm::tap_removal_thread) << wrong;
    EXPECT_EQ(drive.rows.size(), moved) << wrong;
  }
  start("S200 G84.9 Z12 K1.25\nM30\n");
  run();
  EXPECT_NEAR(drive.rows.back()[2], from + 12, 1e-9);
  EXPECT_EQ(core->tap(), program_execution::TapInHole{});
  // It is out: there is nothing to compare with.
  start("S200 G84.9 Z12 K2\nM30\n");
  run();
  EXPECT_NEAR(drive.rows.back()[2], from + 24, 1e-9);
}

TEST_F(Tap, NoTapIsLeftBehindAWholeHole) {
  start(hole);
  run();
  EXPECT_EQ(core->tap(), program_execution::TapInHole{});
}

TEST_F(Tap, SingleBlockStopsBehindTheHoleNotAtItsBottom) {
  start("G90 G94 S400\nG98 G84 X0 Y0 Z-10 R-2 F500\nG80\nM30\n");
  ask(CommandKind::SINGLE_BLOCK, "", 1);
  std::vector<double> stops;
  for (int i = 0; i < 5 && core->run_state() != RunState::IDLE; ++i) {
    run();
    stops.push_back(drive.rows.empty() ? 0 : drive.rows.back()[2]);
    ask(CommandKind::CYCLE_START);
  }
  for (const double z : stops) EXPECT_EQ(z, 0);
}

TEST_F(Tap, ResetInTheThreadStopsBothInStep) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_GT(drive.rows.back()[2], -10);
  for (const auto& [z, turns] : coupled()) ASSERT_NEAR(2 - z, 1.25 * turns, 1e-9);
  // Then the axes have their own limits again: 1 mm takes less time than the spindle would need.
  load("G90 G1 Z0 F24000\nM30\n");
  const auto before = drive.rows.size();
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(drive.rows.back()[2], 0);
  EXPECT_LT(drive.rows.size() - before, 400u);
}

TEST_F(Tap, PecksAndDwellsStayCoupled) {
  start("G90 G94 S400 G0 Z5\nG99 G84 X0 Y0 Z-10 R2 Q5 P100 F500\nG80\nM30\n");
  run();
  const auto rows = coupled();
  int dwelling = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_NEAR(2 - rows[i].first, 1.25 * rows[i].second, 1e-9);
    dwelling += rows[i].first == -10 && rows[i - 1].first == -10 ? 1 : 0;
  }
  EXPECT_GE(dwelling, 100) << "P100 at the bottom";
}

TEST_F(Tap, AMachineWithoutASpindleRefusesItBeforeTheToolIsInTheHole) {
  parameters = three_axes();
  begin();
  start("G90 G94 S400 G0 Z5\nG99 G84 X0 Y0 Z-10 R2 F500\nM30\n");
  run();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::tapping_spindle_missing);
  ASSERT_FALSE(drive.rows.empty());
  EXPECT_EQ(drive.rows.back()[2], 2);
}

TEST_F(Tap, AHoleBeyondTheTravelEndsTheProgramAboveIt) {
  start("G90 G94 S400 G0 Z5\nG99 G84 X0 Y0 Z-410 R2 F500\nM30\n");
  run(100);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::travel_limit);
  ASSERT_FALSE(drive.rows.empty());
  EXPECT_EQ(drive.rows.back()[2], 2);
}

TEST_F(Tap, AfterTheStreamWasLostInTheThreadTheProgramCannotBeResumed) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  drive.forget();
  round();
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  const auto moved = drive.rows.size();
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::not_resumable);
  EXPECT_EQ(drive.rows.size(), moved) << "nothing moved again";
}

}  // namespace
}  // namespace trunnion::channel
