// SPDX-License-Identifier: Apache-2.0
// Rigid tapping: the spindle's angle and the depth are one, whatever the speed does; what the operator may
// do.
#include <cstdint>
#include <string>
#include <vector>

#include "machine/alarm_constants.hpp"
#include "tapping_fixture.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using tapping_test::hole;
using tapping_test::Tap;
using testing::three_axes;

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

TEST_F(Tap, ASpindleThatTurnsIsNotCoupled) {
  drive.spindle_speed = [] { return -1000.0; };
  start(hole);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::tapping_spindle_turns);
  EXPECT_NE(events.back().text.find("S turns at -1000 1/min"), std::string::npos) << events.back().text;
  EXPECT_TRUE(coupled().empty());
  EXPECT_EQ(drive.rows.back()[2], 2);
}

// Feedback from before the PLC's answer says that the spindle turns: the first three messages at R.
TEST_F(Tap, ASpindleThatHasComeToRestIsCoupledWhateverTheFeedbackOfBeforeSays) {
  int older = 3;
  drive.spindle_speed = [&] {
    const bool at_hole = !drive.rows.empty() && drive.rows.back()[2] == 2;
    return at_hole && older-- <= 0 ? 4.0 : 900.0;
  };
  start(hole);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  EXPECT_LT(older, 0);
  EXPECT_FALSE(coupled().empty());
  EXPECT_EQ(drive.rows.back()[2], 20);
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
  by_hand("G90 G0 Z20");
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

// The hole begins at Z2. A program would start with the spindle at rest; by hand the axes move as ever.
TEST_F(Tap, WithATapInItsHoleNoProgramStartsButItsRemoval) {
  leave_tap_in_hole();
  const double depth = 2 - drive.rows.back()[2];
  ASSERT_GT(depth, 7);
  const auto tap = core->tap().words(depth);
  EXPECT_EQ(core->state().detail, "a tap is in its hole: " + tap + "; G84.9 or G39+ removes it");
  const auto answer = ask(CommandKind::START_FROM_LINE, "", 3);
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.alarm, alarm::tap_removal_thread.number);
  EXPECT_EQ(answer.reason,
            "A tap is in its hole: " + tap + ". Remove it with G84.9 (NUM: G39+) by MDI, then start");
  const auto moved = drive.rows.size();
  for (const char* program :
       {"G90 G0 Z20\nM30\n", "G91 G1 X1 F100\nM30\n", "G90 G95 S400\nG99 G84 Z-20 R-6 F1.25\nM30\n",
        "G91 G95 S400\nG99 G84 Z-5 R0 F1.25\nM30\n"}) {
    events.clear();
    start(program);
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    ASSERT_FALSE(events.empty()) << program;
    EXPECT_EQ(events.back().alarm, &alarm::tap_removal_thread) << program;
    EXPECT_NE(events.back().text.find(tap), std::string::npos) << events.back().text;
    EXPECT_EQ(drive.rows.size(), moved) << program;
  }
  by_hand("G90 G0 Z20");
  EXPECT_EQ(drive.rows.back()[2], 20);
  EXPECT_EQ(core->state().detail, "");
  events.clear();
  start("G90 G0 Z5\nM30\n");
  run();
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(drive.rows.back()[2], 5);
  EXPECT_EQ(core->tap(), program_execution::TapInHole{}) << "it was removed otherwise";
}

TEST_F(Tap, BehindTheRemovalOfItsTapAProgramGoesOn) {
  leave_tap_in_hole();
  start("S200\nG84.9 Z12 K1.25\nG90 G0 X5\nM30\n");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(drive.rows.back()[0], 5);
}

TEST_F(Tap, AnInterruptionTellsOfTheTapThatIsInItsHoleAndSoDoesTheOfferOfItsLine) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  events.clear();
  drive.mode = DriveMode::OFF;
  for (int i = 0; i < 2; ++i) round();
  const auto tap = "; a tap is in its hole: " + core->tap().words(2 - drive.rows.back()[2]);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::interrupted);
  EXPECT_EQ(events.back().text, "The drives were switched off" + tap);
  ask(CommandKind::RESET);
  round();
  const auto kept = core->running_program();
  EXPECT_EQ(kept.line, 3u);
  events.clear();
  begin(kept);
  round();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::switched_off_in_program);
  EXPECT_EQ(events.back().text, "Program part.nc was in line 3 when the control was switched off" + tap +
                                    ". Remove it with G84.9 (NUM: G39+) by MDI, then start from there");
}

// The M3 behind the hole has not been answered when the process is killed.
TEST_F(Tap, AProgramGoesOnBehindAWholeHoleInAnotherProcess) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -5) round();
  answer_plc = false;
  for (int i = 0; i < 100000 && m_codes() != std::vector<int>{3, 5, 3}; ++i) round();
  ASSERT_EQ(m_codes(), (std::vector<int>{3, 5, 3}));
  EXPECT_EQ(core->link().snapshot().fraction, 1);
  answer_plc = true;
  events.clear();
  begin(core->running_program());
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[2], 20);
  for (const auto& event : events) EXPECT_NE(event.alarm, &alarm::not_resumable) << event.text;
  EXPECT_EQ(m_codes(), (std::vector<int>{3, 5, 3, 3, 30}));
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
  const auto before = drive.rows.size();
  by_hand("G90 G1 Z0 F24000");
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

/// Of three spindles, of which `slave` follows `master`.
auto synchronized(std::size_t slave, std::int8_t master, idl::stream::SpindleCondition condition) {
  return [=](std::uint64_t) {
    std::vector<idl::stream::SpindleState> states(3);
    for (auto& state : states) state.master = -1, state.homed = true;
    states[slave].master = master, states[slave].condition = condition;
    return states;
  };
}

// S is spindle 0. A part may be in the chucks of both: only one of them would follow the path.
TEST_F(Tap, ASpindleThatFollowsOrLeadsAnotherOneRefusesItBeforeTheToolIsInTheHole) {
  using idl::stream::SpindleCondition;
  parameters->values[106000] = {0, "S2"}, parameters->values[106001] = {10, ""};
  parameters->values[107000] = {0, "S3"}, parameters->values[107001] = {10, ""};
  const auto refused = [&](const std::string& program) {
    events.clear(), auxiliaries.clear();
    start(program);
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE) << program;
    return !events.empty() && events.back().alarm == &alarm::tapping_spindle_synchronized;
  };
  const std::string removal = "S200 G84.9 Z12 K1.25\nM30\n";
  for (const auto condition :
       {SpindleCondition::SPINDLE_SYNCHRONIZING, SpindleCondition::SPINDLE_SYNCHRONIZED})
    for (const bool leads : {false, true}) {
      drive = testing::FakeDrive(3);
      drive.spindle_states = leads ? synchronized(2, 0, condition) : synchronized(0, 2, condition);
      begin();
      ASSERT_TRUE(refused(hole)) << leads;
      EXPECT_EQ(events.back().text,
                "part.nc:3: rigid tapping with a spindle that is synchronized with another one: end the "
                "synchronization first");
      EXPECT_EQ(drive.rows.back()[2], 2);
      EXPECT_EQ(m_codes(), (std::vector<int>{3, 5})) << "both have stopped";
      EXPECT_TRUE(refused(removal)) << leads;
      EXPECT_EQ(drive.rows.back()[2], 2);
      EXPECT_TRUE(coupled().empty());
    }
  drive = testing::FakeDrive(3);
  drive.spindle_states = synchronized(1, 2, SpindleCondition::SPINDLE_SYNCHRONIZED);
  begin();
  EXPECT_FALSE(refused(hole)) << "two others";
  EXPECT_FALSE(coupled().empty());
  EXPECT_EQ(drive.rows.back()[2], 20);
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

// 10 mm at a lead of 1.25 mm are 8 turns, counter-clockwise out of a right-hand thread; a spindle that gains
// 2000 1/min in a second gains 2 in a cycle. W is the axis 3.
TEST_F(Tap, ATapIsMovedOutAlongASecondaryAxisButNotOneThatIsKnownToBeInAHoleAlongAnother) {
  parameters->values[40009] = {3, ""}, parameters->values[103000] = {0, "W"};
  parameters->values[103006] = {400, ""}, parameters->values[103007] = {-400, ""};
  const std::string removal = "S200 G84.9 W10 K1.25\nM30\n";
  drive = testing::FakeDrive(4);
  begin();
  start(removal);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  std::vector<double> turns;
  for (std::size_t i = 0; i < drive.rows.size(); ++i) {
    if (!drive.spindle[i]) continue;
    ASSERT_NEAR(drive.rows[i][8], -1.25 * *drive.spindle[i], 1e-9);
    EXPECT_EQ(drive.rows[i][2], 0);
    turns.push_back(*drive.spindle[i]);
  }
  ASSERT_GT(turns.size(), 1000u);
  EXPECT_NEAR(turns.back(), -8, 1e-9);
  for (std::size_t i = 2; i < turns.size(); ++i) {
    const double gain = (turns[i] - 2 * turns[i - 1] + turns[i - 2]) * 60000;  // 1/min in a cycle
    ASSERT_LE(std::abs(gain), 2 * (1 + 1e-3));
  }
  // It was left in a hole along Z.
  drive = testing::FakeDrive(4);
  begin();
  leave_tap_in_hole();
  events.clear();
  const auto moved = drive.rows.size();
  start(removal);
  run();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::tap_removal_thread);
  EXPECT_EQ(drive.rows.size(), moved);
}

}  // namespace
}  // namespace trunnion::channel
