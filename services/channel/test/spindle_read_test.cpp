// SPDX-License-Identifier: Apache-2.0
// Values of spindles that a program reads at rest, and orders for spindles.
#include "spindle_read.hpp"

#include "canonical/spindle_value.hpp"
#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using canonical::SpindleValue;
using idl::channel::AuxiliaryKind;
using idl::channel::CommandKind;
using idl::stream::SpindleCondition;
using testing::Channel;
using testing::FakeDrive;

/// Two spindles whose reference is the number of executed cycles; the second one is synchronized from 400 on.
std::vector<idl::stream::SpindleState> states_at(std::uint64_t next) {
  std::vector<idl::stream::SpindleState> states(2);
  states[0].master = states[1].master = -1;
  for (auto& state : states) state.homed = true, state.reference = static_cast<double>(next);
  states[1].condition =
      next >= 400 ? SpindleCondition::SPINDLE_SYNCHRONIZED : SpindleCondition::SPINDLE_SYNCHRONIZING;
  return states;
}

struct SpindleReading : Channel {
  void start(const std::string& program) {
    drive.spindle_states = states_at;
    load(program);
    EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  }
  double kept(std::size_t i) {
    if (const auto* news = core->take_variables()) variables = *news;
    return variables.kept[i].number;
  }
  language::VariableStore variables;
};

TEST(SpindleValueOf, IsTakenFromTheStateOfTheSpindle) {
  idl::stream::Feedback feedback;
  feedback.spindles = states_at(400);
  auto& state = feedback.spindles[1];
  state.master = 0, state.synchronization_error = -0.25, state.angle = -1.25;
  const auto value = [&](SpindleValue which) {
    return spindle_value(feedback, canonical::read_number(which, 1));
  };
  EXPECT_EQ(value(SpindleValue::homed), 1);
  EXPECT_EQ(value(SpindleValue::synchronized), 1);
  EXPECT_EQ(value(SpindleValue::master), 1);
  EXPECT_EQ(value(SpindleValue::error), -90);
  EXPECT_EQ(value(SpindleValue::reference), 400);
  EXPECT_EQ(value(SpindleValue::angle), 270) << "-1.25 revolutions are -2 and 3 quarters";
  EXPECT_EQ(value(SpindleValue::positioned), 0);
  state.condition = SpindleCondition::SPINDLE_ORIENTED;
  EXPECT_EQ(value(SpindleValue::positioned), 1);
  EXPECT_EQ(spindle_value(feedback, canonical::read_number(SpindleValue::homed, 2)), 0) << "there is none";
}

TEST(SpindleValueOf, TheSynchronizedSpindlesAreSlavesAndTheirMasters) {
  idl::stream::Feedback feedback;
  EXPECT_EQ(synchronized_spindles(feedback), 0u);
  feedback.spindles = states_at(0);
  feedback.spindles.resize(4);
  feedback.spindles[1].condition = SpindleCondition::SPINDLE_AT_SPEED;
  EXPECT_EQ(synchronized_spindles(feedback), 0u) << "0 in master is none of a spindle that does not follow";
  feedback.spindles[3].condition = SpindleCondition::SPINDLE_SYNCHRONIZING;
  feedback.spindles[3].master = 1;
  EXPECT_EQ(synchronized_spindles(feedback), 0b1010u);
}

// Each reading waits 10 ms, 10 cycles: a loop of readings alone reaches cycle 400.
TEST_F(SpindleReading, ALoopWaitsAndReadsTheSameHoweverTheFeedbackArrives) {
  std::vector<double> runs[2];
  for (const std::uint64_t cycles : {1ull, 1000ull}) {
    drive = FakeDrive(3);
    begin();
    cycles_per_round = cycles;
    start("G90 G54 G1 X1 F1200\n#500=#4841\nWHILE #4812 EQ 0\nENDW\n#501=#4842\nG1 X2\nM30\n");
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    EXPECT_EQ(drive.rows.back()[0], 2);
    runs[cycles == 1 ? 0 : 1] = {kept(0), kept(1), static_cast<double>(drive.rows.size())};
  }
  EXPECT_EQ(runs[0], runs[1]);
  EXPECT_GE(runs[0][0], 50 + 10) << "1 mm at 20 mm/s is 50 cycles";
  EXPECT_LT(runs[0][0], 400);
  EXPECT_GE(runs[0][1], 410);
  EXPECT_TRUE(events.empty());
}

// The program is 160 cycles under way when the drive restarts: read again, the value would be above that.
TEST_F(SpindleReading, ARestartReadsTheValueOfBefore) {
  drive.spindle_states = states_at;
  load("#500=#4841\nG1 X50 F1200\nM30\n");
  start_and_go_on_after_a_restart_of_the_drive();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 50);
  EXPECT_GE(kept(0), 10);
  EXPECT_LT(kept(0), 160);
}

TEST_F(SpindleReading, AResetInTheWaitForgetsIt) {
  start("WHILE #4812 EQ 0\nENDW\nM30\n");
  cycles_per_round = 8;
  for (int i = 0; i < 10; ++i) round();
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  start("G90 G1 X1 F1200\nM30\n");
  run();
  EXPECT_EQ(drive.rows.back()[0], 1);
}

TEST_F(SpindleReading, AnOrderGoesToThePlcWithItsParameter) {
  start("#4822=1\n#4880=90\nM30\n");
  run();
  ASSERT_EQ(auxiliaries.size(), 3u);
  EXPECT_EQ(auxiliaries[0].kind, AuxiliaryKind::E);
  EXPECT_EQ(auxiliaries[0].code, 94125u);
  EXPECT_EQ(auxiliaries[0].value, 24);
  EXPECT_TRUE(auxiliaries[0].has_value);
  EXPECT_EQ(auxiliaries[1].code, 0u);
  EXPECT_EQ(auxiliaries[1].value, 90);
}

TEST_F(SpindleReading, AMasterWithoutItsMarkIsAnAlarmThatNamesIt) {
  start("#4822=1\nM30\n");
  drive.spindle_states = [](std::uint64_t next) {
    auto states = states_at(next);
    states[1].homed = false;
    return states;
  };
  run();
  EXPECT_TRUE(auxiliaries.empty());
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NE(events[0].text.find("spindle 2"), std::string::npos) << events[0].text;
}

}  // namespace
}  // namespace trunnion::channel
