// SPDX-License-Identifier: Apache-2.0
// Signals of the PLC that a program reads and sets.
#include "channel_fixture.hpp"

namespace trunnion::channel::macro_signal_test {
namespace {

using idl::channel::AuxiliaryKind;
using idl::channel::CommandKind;
using testing::Channel;

struct MacroSignals : Channel {
  void start(const std::string& program) {
    load(program);
    EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  }
  double kept(std::size_t i) {
    if (const auto* news = core->take_variables()) variables = *news;
    return variables.kept[i].number;
  }
  std::vector<std::uint32_t> orders() const {
    std::vector<std::uint32_t> codes;
    for (const auto& one : auxiliaries)
      if (one.kind == AuxiliaryKind::E) codes.push_back(one.code);
    return codes;
  }
  language::VariableStore variables;
};

TEST_F(MacroSignals, AreReadAndSetInTheOrderOfTheProgram) {
  signals_in = 0b1000;
  start("#500=#1003\n#501=#1002\n#1105=1\n#502=#1132\n#503=#1032\nM30\n");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(kept(0), 1);
  EXPECT_EQ(kept(1), 0);
  EXPECT_EQ(kept(2), 32) << "2 to the power of 5";
  EXPECT_EQ(kept(3), 8);
  EXPECT_EQ(orders(), (std::vector<std::uint32_t>{1003, 1002, 1105, 1132, 1032}));
  EXPECT_TRUE(auxiliaries[2].has_value);
  EXPECT_EQ(auxiliaries[2].value, 1);
  EXPECT_FALSE(auxiliaries[0].has_value);
}

TEST_F(MacroSignals, AProgramWaitsForOne) {
  start("WHILE #1000 EQ 0\nENDW\nG90 G1 X2 F1200\nM30\n");
  cycles_per_round = 8;
  for (int i = 0; i < 50; ++i) round();
  EXPECT_NE(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 0);
  signals_in = 1;
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 2);
}

TEST_F(MacroSignals, ThatThePlcDoesNotUseEndTheProgramWithTheRegisterThatItLacks) {
  answer_plc = false;
  start("#500=#1003\nG1 X5 F1000\nM30\n");
  for (int i = 0; i < 100 && auxiliaries.empty(); ++i) round();
  ASSERT_EQ(auxiliaries.size(), 1u);
  core->on_auxiliary_done({0, auxiliaries[0].number, true});
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text,
            "part.nc:1: the PLC did not carry out #1003: its programs do not use the register macro_input_0. "
            "Correct the program or the PLC, then reset");
  EXPECT_EQ(drive.rows.back()[0], 0);
}

TEST_F(MacroSignals, OnlyTheAnswerToTheOpenQuestionCounts) {
  answer_plc = false;
  start("#500=#1003\nM30\n");
  for (int i = 0; i < 100 && auxiliaries.empty(); ++i) round();
  ASSERT_EQ(auxiliaries.size(), 1u);
  const auto number = auxiliaries[0].number;
  core->on_macro_signal({0, number - 1, 7});
  core->on_auxiliary_done({0, number, false});  // has no value
  round();
  EXPECT_EQ(core->run_state(), RunState::WAITING);
  answer_plc = true;
  core->on_macro_signal({0, number, 1});
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(kept(0), 1);
}

TEST_F(MacroSignals, AResetInTheWaitForgetsTheQuestion) {
  answer_plc = false;
  start("#500=#1003\nM30\n");
  for (int i = 0; i < 100 && auxiliaries.empty(); ++i) round();
  ASSERT_EQ(auxiliaries.size(), 1u);
  const auto number = auxiliaries[0].number;
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  core->on_macro_signal({0, number, 1});
  answer_plc = true;
  start("G90 G1 X1 F1200\nM30\n");
  run();
  EXPECT_EQ(drive.rows.back()[0], 1);
}

// The program is under way behind the question when the drive restarts.
TEST_F(MacroSignals, ARestartReadsTheValueOfBefore) {
  signals_in = 0b1000;
  load("#500=#1003\nG90 G1 X50 F1200\nM30\n");
  start_and_go_on_after_a_restart_of_the_drive();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 50);
  EXPECT_EQ(kept(0), 1);
  EXPECT_EQ(orders(), std::vector<std::uint32_t>{1003}) << "the PLC is not asked again";
}

// An auxiliary lock keeps the program from the PLC's outputs; what it reads goes on.
TEST_F(MacroSignals, WithTheAuxiliaryLockTheyAreReadAndNotSet) {
  signals_in = 1;
  load("#1101=1\n#500=#1000\nM30\n");
  ASSERT_TRUE(ask(CommandKind::AUXILIARY_LOCK, "", 1).accepted);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(orders(), std::vector<std::uint32_t>{1000});
  EXPECT_EQ(signals_out, 0);
  EXPECT_EQ(kept(0), 1);
}

}  // namespace
}  // namespace trunnion::channel::macro_signal_test
