// SPDX-License-Identifier: Apache-2.0
// Variables and functions of Fanuc's custom macros: what they show, what writing them does, which are
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test::fanuc_variables {
namespace {

using testing::ElementsAre;

/// #500 and those behind it, which the text gives the values.
std::vector<double> kept_after(Environment& machine, const std::string& text, std::size_t count,
                               double parts = 0) {
  Interpreter interpreter(machine);
  StringSource source(text);
  interpreter.set_parts(parts);
  interpreter.start(source, {}, {});
  Command command;
  Step step = Step::command;
  while (step == Step::command || step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(step, Step::end) << interpreter.alarm().text.data();
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(interpreter.variables().kept[i].number);
  return values;
}

TEST(FanucVariables, ToolsAndOffsetsHaveTheNumbersOfLargeTablesToo) {
  TestMachine machine;
  machine.tools[300] = {50, 0.5, 4, 0.1};
  machine.more_offsets[1] = {7, 8, 9};
  EXPECT_THAT(
      kept_after(machine,
                 "#500=#10300\n#501=#11300\n#502=#12300\n#503=#13300\n#504=#14002\n#505=#14021\nM30\n", 6),
      ElementsAre(0.5, 50, 0.1, 4, 8, 0));
  machine.tools[1] = {50, 0, 4, 0};
  EXPECT_THAT(stream(run(machine, "#11001=60\n#12001=-0.1\n#14041=3\nG54.1 P3 X0\nG43 H1 Z0\nM30\n")),
              ElementsAre("table2 1 60", "table5 1 -0.1", "table1 8 X3", "rapid X3", "frame none L60 X3",
                          "rapid X3 Z60", "end 30"));
}

TEST(FanucVariables, WorkOffsetsByAxisAreToolsUnlessTheMachineSaysOtherwise) {
  TestMachine machine;
  machine.offsets[0] = {1, 2, 3};
  machine.offsets[5] = {10, 20, 30};
  machine.tools[101] = {0, 0, 0, 0.25};  // #2401 is the wear of tool 1, so #2501 that of tool 101
  const std::string text = "#500=#2501\n#501=#2506\n#502=#2601\n#503=#2706\nM30\n";
  EXPECT_THAT(kept_after(machine, text, 4), ElementsAre(0.25, 0, 0, 0));
  machine.by_axis = true;
  EXPECT_THAT(kept_after(machine, text, 4), ElementsAre(1, 10, 2, 30));
  EXPECT_THAT(stream(run(machine, "#2602=5\nG55 Y0\nM30\n")),
              ElementsAre("table1 1 Y5", "rapid Y5", "end 30"));
  machine.added = {0.5, 0.25, 0};
  EXPECT_THAT(kept_after(machine, "#500=#2500\n#501=#2600\n#502=#2700\nM30\n", 3), ElementsAre(0.5, 0.25, 0));
  EXPECT_THAT(stream(run(machine, "#2700=4\nG55 Z0\nM30\n")),
              ElementsAre("table1 54 X0.5 Y0.25 Z4", "rapid Z4", "end 30"))
      << "the external offset, which is added to that of G55";
}

TEST(FanucVariables, ModalWordsOfTheExecutedBlocksAreThoseOfTheBlocksBefore) {
  TestMachine machine;
  EXPECT_THAT(
      kept_after(machine, "G1 F100 G91 S500\n#500=#4201\n#501=#4203\n#502=#4309\n#503=#4319\nM30\n", 4),
      ElementsAre(1, 91, 100, 500));
}

TEST(FanucVariables, MirroredAxesAreASum) {
  TestMachine machine;
  EXPECT_THAT(kept_after(machine, "#500=#3007\nG51.1 X0 A0\n#501=#3007\nG50.1\n#502=#3007\nM30\n", 3),
              ElementsAre(0, 1 + 8, 0));
}

TEST(FanucVariables, PartsAreThoseOfTheBeginningUntilTheProgramWritesThem) {
  TestMachine machine;
  EXPECT_THAT(kept_after(machine, "#500=#3901\n#3901=#3901+5\n#501=#3901\nM30\n", 2, 7), ElementsAre(7, 12));
  EXPECT_THAT(stream(run(machine, "#3901=12\nM30\n")), ElementsAre("table7 0 12", "end 30"));
}

TEST(FanucVariables, WhatAProgramSuppressesIsInTheStateOfItsCommands) {
  TestMachine machine;
  const auto result = run(machine,
                          "G61 G1 F100 X1\n#3003=1\nX2\n#3004=7\nX3\n#3003=0\nX4\n#3004=0\nX5\n"
                          "#3004=3\n#500=#3004\nM30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  std::vector<int> suppressed;
  std::vector<bool> exact;
  for (const Command& command : result.commands) {
    suppressed.push_back(command.modal.suppressed);
    exact.push_back(command.modal.path_control == PathControl::exact_stop);
  }
  EXPECT_THAT(suppressed, ElementsAre(0, 1, 1 + 2 + 4 + 8, 2 + 4 + 8, 0, 2 + 4));
  EXPECT_THAT(exact, ElementsAre(true, true, false, false, true, true));
  EXPECT_THAT(kept_after(machine, "#3004=3\n#500=#3004\n#501=#3003\n#3003=1\n#502=#3003\nM30\n", 3),
              ElementsAre(3, 0, 1));
}

TEST(FanucVariables, TheNextProgramSuppressesNothing) {
  TestMachine machine;
  ModalState modal;
  modal.suppressed = no_single_block | no_override;
  EXPECT_EQ(run(machine, "G0 X1\nM30\n", {}, modal).commands[0].modal.suppressed, 0);
}

TEST(FanucVariables, DecimalDigitsAreCodedInFourBitsAndBack) {
  TestMachine machine;
  // 0x1234 = 4660; 0x99999999 = 2576980377.
  EXPECT_THAT(
      kept_after(machine,
                 "#500=BCD[1234]\n#501=BIN[4660]\n#502=BCD[99999999]\n#503=BIN[BCD[305]]\n#504=ADP[#1]\n"
                 "#505=BCD[0]\nM30\n",
                 6),
      ElementsAre(4660, 1234, 2576980377.0, 305, 0, 0));
  // 0xA = 10 is no decimal digit.
  for (const char* wrong : {"#1=BIN[10]", "#1=BCD[100000000]", "#1=BCD[-1]", "#1=BCD[1.5]", "#1=BIN[-1]"})
    EXPECT_EQ(run(machine, wrong).alarm.number, AlarmNumber::function_domain) << wrong;
}

TEST(FanucVariables, ParametersOfTheMachineAreReadByItsNumbers) {
  TestMachine machine;
  machine.parameters[40901] = 0.01;
  EXPECT_THAT(kept_after(machine, "#1=40900\n#500=PRM[40901]*2\n#501=PRM[#1+1]\nM30\n", 2),
              ElementsAre(0.02, 0.01));
  for (const char* wrong : {"#1=PRM[1320]", "#1=PRM[40901,1]", "#1=PRM[40901]/[1]", "#1=PRM[#1]",
                            "#1=PRM[-1]", "#1=PRM[40901.5]"})
    EXPECT_EQ(run(machine, wrong).alarm.number, AlarmNumber::parameter_unavailable) << wrong;
}

TEST(FanucVariables, SignalsOfThePlcAreReadAtRestAndSetInTheirOrder) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G0 X1\n#1101=1\n#500=#1003\n#1132=-1\nM30\n")),
              ElementsAre("rapid X1", "order 1101 1", "read 1003", "order 1132 -1", "end 30"));
  Interpreter interpreter(machine);
  StringSource source("IF [#1003 EQ 1] GOTO 7\nG0 X9\nN7 G0 X#1032\nM30\n");
  interpreter.start(source, {}, {});
  std::vector<double> values = {40, 1};  // the last one is given first
  std::vector<double> positions;
  Command command;
  for (Step step = Step::working; step != Step::end;) {
    step = interpreter.next(command);
    ASSERT_NE(step, Step::alarm) << interpreter.alarm().text.data();
    if (step == Step::command && command.kind == CommandKind::rapid) positions.push_back(command.target[X]);
    if (step != Step::value) continue;
    ASSERT_FALSE(values.empty());
    interpreter.give_value(values.back());
    values.pop_back();
  }
  EXPECT_THAT(positions, ElementsAre(40));
}

}  // namespace
}  // namespace trunnion::language::test::fanuc_variables
