// SPDX-License-Identifier: Apache-2.0
// Codes of other controls that choose a machining mode or a tolerance: G5, G5.1, G8, G61.1, G62, G63, G187.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

/// Of the last move of `program`, which must be free of alarms.
ModalState modal_of_last_move(const std::string& program) {
  TestMachine machine;
  const Interpretation result = run(machine, program);
  EXPECT_EQ(result.last, Step::end) << program << result.alarm.text.data();
  ModalState modal;
  for (const Command& command : result.commands)
    if (command.kind == CommandKind::line) modal = command.modal;
  return modal;
}

struct Mode {
  const char* codes;
  int smoothing;     ///< 0 usual, 1 high precision, 2 high speed and high precision
  double tolerance;  ///< mm; 0 = that of the mode
};

TEST(MachiningModes, EachCodeChoosesTheSetThatItsPageStates) {
  const Mode modes[] = {
      {"G5 P10000\n", 1, 0},
      {"G05 P10000\nG05 P0\n", 0, 0},
      {"G5 P1\n", 2, 0},
      {"G5 P3\n", 2, 0},
      {"G5.1 Q1\n", 1, 0},
      {"G5.1 Q1 R1\n", 2, 0},
      {"G5.1 Q1 R5\n", 2, 0},
      {"G5.1 Q1 R6\n", 1, 0},
      {"G5.1 Q1 R10\n", 1, 0},
      {"G5.1 Q2\n", 2, 0},
      {"G5.1 Q3 X0 Y0 Z0\n", 2, 0},
      {"G5.1 Q1\nG5.1 Q0\n", 0, 0},
      {"G8 P1\n", 1, 0},
      {"G08 P1\nG08 P0\n", 0, 0},
      {"G187 P1\n", 0, 0},
      {"G187 P2\n", 2, 0},
      {"G187 P3\n", 1, 0},
      {"G187 P3 E0.02\n", 1, 0.02},
      // 0.001 inch
      {"G20\nG187 E.001\nG21\n", 0, 0.0254},
      {"G187 P3 E0.02\nG187\n", 0, 0},
      {"G187 P3 E0.02\nG64\n", 1, 0},
      // Modes stay over codes that say nothing about them.
      {"G5.1 Q2\nG61\nG64 P0.1\n", 2, 0.1},
  };
  for (const Mode& mode : modes) {
    const ModalState modal = modal_of_last_move(std::string(mode.codes) + "G1 X10 F100\nM30\n");
    EXPECT_EQ(modal.smoothing, mode.smoothing) << mode.codes;
    EXPECT_NEAR(modal.path_tolerance, mode.tolerance, 1e-12) << mode.codes;
    EXPECT_EQ(modal.path_control, PathControl::continuous) << mode.codes;
  }
}

TEST(MachiningModes, TheAccuratePathLastsUntilTheNextCodeOfItsGroup) {
  const Mode modes[] = {
      {"G61.1\n", 1, 0},
      {"G61.1\nG64\n", 0, 0},
      {"G61.1\nG62\n", 0, 0},
      {"G61.1\nG63\n", 0, 0},
      {"G64 P0.2\nG61.1\n", 1, 0},
      // A mode that the program has chosen is not taken back.
      {"G5.1 Q2\nG61.1\n", 2, 0},
      {"G61.1\nG5.1 Q2\nG64\n", 2, 0},
      {"G61.1\nG5.1 Q0\n", 1, 0},
      {"G61.1\nG5.1 Q0\nG64\n", 0, 0},
  };
  for (const Mode& mode : modes) {
    const ModalState modal = modal_of_last_move(std::string(mode.codes) + "G1 X10 F100\nM30\n");
    EXPECT_EQ(modal.smoothing, mode.smoothing) << mode.codes;
    EXPECT_NEAR(modal.path_tolerance, mode.tolerance, 1e-12) << mode.codes;
  }
  EXPECT_EQ(modal_of_last_move("G61\nG63\nG1 X1 F100\n").path_control, PathControl::continuous);
  EXPECT_EQ(modal_of_last_move("G61.1\nG61\nG1 X1 F100\n").path_control, PathControl::exact_stop);
  EXPECT_EQ(modal_of_last_move("G61.1\nG61\nG1 X1 F100\n").smoothing, 0);
}

TEST(MachiningModes, AnAxisThatAModeNamesDoesNotMove) {
  TestMachine machine;
  const auto commands = stream(run(machine, "G1 X5 Y6 F100\nG5.1 Q2 X0 Y0\nX7\nG5.1 Q1 X8\nM30\n"));
  EXPECT_EQ(commands,
            (std::vector<std::string>{"line X5 Y6 F100", "line X7 Y6 F100", "line X8 Y6 F100", "end 30"}));
}

// R and P of a cycle in the block are the cycle's.
TEST(MachiningModes, WordsOfACycleStayItsOwn) {
  TestMachine machine;
  const auto result = run(machine, "G99 G81 Z-4 R1 F100 L0\nG5.1 Q1 X2 R3\nM30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  EXPECT_EQ(result.modal.smoothing, 1);
  EXPECT_NEAR(result.commands[result.commands.size() - 2].target[Z], 3, 1e-12) << "out to R3";
}

// The next line of manual data input finds the mode, the start of a program does not.
TEST(MachiningModes, StaysFromLineToLine) {
  TestMachine machine;
  Interpreter interpreter(machine);
  const auto read = [&](const std::string& text, Beginning beginning) {
    StringSource source(text);
    interpreter.start(source, interpreter.position(), interpreter.modal(), no_variables, beginning);
    Command command;
    Step step = Step::command;
    while (step == Step::command || step == Step::working) step = interpreter.next(command);
    EXPECT_EQ(step, Step::end) << text << interpreter.alarm().text.data();
    return interpreter.modal();
  };
  EXPECT_EQ(read("G61.1\n", Beginning::program).smoothing, 1);
  EXPECT_EQ(read("G1 X1 F100\n", Beginning::line).smoothing, 1);
  EXPECT_EQ(read("G64\n", Beginning::line).smoothing, 0);
}

TEST(MachiningModes, WhatTheyDoNotKnowIsAnAlarmThatSaysWhatTheyTake) {
  struct Case {
    const char* program;
    AlarmNumber number;
    const char* says;
  };
  const Case cases[] = {
      // The header of the high-speed cycle machining of Fanuc, which calls data.
      {"G5 P10001\n", AlarmNumber::value_range, "P10001, G5 takes P0, P1 to P3 and P10000"},
      {"G5 P4\n", AlarmNumber::value_range, "P4, G5 takes P0, P1 to P3 and P10000"},
      {"G5\n", AlarmNumber::missing_word, "needs P"},
      {"G8\n", AlarmNumber::missing_word, "needs P"},
      {"G8 P2\n", AlarmNumber::value_range, "P2"},
      {"G5.1 Q4\n", AlarmNumber::value_range, "Q4"},
      {"G5.1 Q1 R11\n", AlarmNumber::value_range, "R11"},
      {"G5.1 Q0 R3\n", AlarmNumber::unused_word, "R3"},
      {"G5.1 Q2 X5\n", AlarmNumber::value_range, "X5, only names an axis here: write 0"},
      {"G187 P4\n", AlarmNumber::value_range, "P4"},
      {"G187 E-1\n", AlarmNumber::value_range, "E-1"},
      {"G62 P1\n", AlarmNumber::unused_word, "P1"},
      {"G61.1 G64\n", AlarmNumber::group_twice, "G64"},
      {"G43.1 H1\n", AlarmNumber::foreign_word, "G43.1, Fanuc: write G43.4 H_, or G43 H_ behind G68.2"},
      {"G54.2 P1\n", AlarmNumber::foreign_word, "G54.2, Fanuc: write G43.4 H_: the zero turns along"},
      {"G77\n", AlarmNumber::unknown_g, "G77"},
  };
  for (const Case& c : cases) {
    TestMachine machine;
    machine.lengths = {{1, 50.0}};
    const auto result = run(machine, c.program);
    EXPECT_EQ(result.last, Step::alarm) << c.program;
    EXPECT_EQ(result.alarm.number, c.number) << c.program << result.alarm.text.data();
    EXPECT_TRUE(std::string(result.alarm.text.data()).ends_with(c.says)) << result.alarm.text.data();
  }
}

TEST(MachiningModes, ACodeWithoutEffectSaysWhy) {
  for (const std::uint32_t tenths : {620u, 630u, 1201u}) {
    ASSERT_NE(g_code(tenths), nullptr);
    EXPECT_NE(g_code(tenths)->no_effect, nullptr) << tenths;
  }
  EXPECT_EQ(g_code(640)->no_effect, nullptr);
}

TEST(MachiningModes, AMachiningConditionChangesNothing) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G1 X1 F100\nG120.1 P1 Q3\nX2\nG120.1 Q0\nM30\n")),
              testing::ElementsAre("line X1 F100", "line X2 F100", "end 30"));
  EXPECT_EQ(run(machine, "G120.1 P1 X5\n").alarm.number, AlarmNumber::unused_word);
}

}  // namespace
}  // namespace trunnion::language::test
