// SPDX-License-Identifier: Apache-2.0
// What DPRNT prints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test::print_lines {
namespace {

using testing::ElementsAre;

std::vector<std::string> printed(TestMachine& machine, const std::string& text) {
  Interpreter interpreter(machine);
  StringSource source(text);
  interpreter.start(source, {}, {});
  std::vector<std::string> lines;
  Command command;
  Step step = Step::command;
  while (step == Step::command || step == Step::working) {
    step = interpreter.next(command);
    if (step == Step::command && command.kind == CommandKind::print)
      lines.emplace_back(interpreter.print_text());
  }
  EXPECT_EQ(step, Step::end) << interpreter.alarm().text.data();
  return lines;
}

// The values, formats and both layouts of the example of DPRNT in Fanuc B-64484EN, "External output
// commands"; there T#30[20] loses a digit, here the number grows.
TEST(Print, NumbersHaveThePlacesOfTheirFormat) {
  TestMachine machine;
  const std::string program =
      "POPEN\n#2=128.47398\n#5=-91.2\n#30=123.456\nDPRNT[X#2[53]*Y#5[53]*T#30[20]]\nPCLOS\nM30\n";
  EXPECT_THAT(printed(machine, program), ElementsAre("X   128.474 Y-   91.200 T 123"));
  machine.blanks = false;
  EXPECT_THAT(printed(machine, program), ElementsAre("X128.474 Y-91.200 T123"));
}

TEST(Print, ZeroHasADigitAndNoSign) {
  TestMachine machine;
  EXPECT_THAT(printed(machine, "#1=-0.0004\nDPRNT[#1[13],#1[04],#2[10]]\nM30\n"),
              ElementsAre(" 0.000,-0.0004, 0"))
      << "a vacant variable counts as 0";
}

TEST(Print, TextIsPrintedAsItIsWrittenAndTheAsteriskIsABlank) {
  TestMachine machine;
  EXPECT_THAT(
      printed(machine, "dprnt[Bohrung*ø 8 (mm);#[100+1][20]] (comment)\nDPRNT[]\nN5 DPRNT[A\x01]\nM30\n"),
      ElementsAre("Bohrung ø 8 (mm);  0", "", "A?"));
}

TEST(Print, ALineIsPrintedWhereTheProgramPassesIt) {
  TestMachine machine;
  EXPECT_THAT(
      printed(machine,
              "#1=1\nWHILE [#1 LE 3] DO1\nIF [#1 EQ 2] THEN DPRNT[two]\nIF [#1 EQ 3] GOTO 9\n#1=#1+1\n"
              "END1\nDPRNT[never]\nN9 DPRNT[#1[10]]\nM30\n"),
      ElementsAre("two", " 3"));
  const auto result = run(machine, "G0 X1\nDPRNT[A]\nX2\nM30\n");
  EXPECT_THAT(stream(result), ElementsAre("rapid X1", "print", "rapid X2", "end 30"));
  EXPECT_EQ(result.commands[1].line, 2u);
}

TEST(Print, TheTextIsThatOfTheCommandHoweverTheProgramComes) {
  TestMachine machine;
  SlowSource source("G0 X1\n#1=5\nDPRNT[A#1[10]]\nG1 X2 F100\nM30\n", 5);
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  Command command;
  for (Step step = Step::command; step != Step::end;) {
    step = interpreter.next(command);
    ASSERT_NE(step, Step::alarm) << interpreter.alarm().text.data();
    if (step == Step::command && command.kind == CommandKind::print) break;
  }
  ASSERT_EQ(command.kind, CommandKind::print);
  EXPECT_EQ(interpreter.print_text(), "A 5");
}

TEST(Print, CutterCompensationWouldHoldItBack) {
  TestMachine machine;
  machine.tools[1] = {0, 0, 2, 0};
  const auto result = run(machine, "G41 D1 G1 X10 F100\nDPRNT[A]\nX20\nM30\n");
  EXPECT_EQ(result.alarm.number, AlarmNumber::compensation_active);
  EXPECT_EQ(result.alarm.line, 2u);
}

}  // namespace
}  // namespace trunnion::language::test::print_lines
