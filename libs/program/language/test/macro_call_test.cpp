// SPDX-License-Identifier: Apache-2.0
// Calls with arguments, modal calls, cycles, and whose variables are whose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

TestMachine machine_with_cycles() {
  TestMachine machine;
  machine.programs["USERDEF.CYC"] = std::make_unique<StringSource>(
      "%1007\nG91 G0 X[#23] Z[#25]\nG90\nM99\n"
      "%1010\nIF [AR[#7] EQ 0] ; H number is not defined\n#3000=1(H IS MISSING)\nENDIF\nG0 Y#7\nM99\n"
      "%1011\nG1010 H[#7+1]\nM98 P1007\nM99\n");
  machine.cycle_m_codes[3] = 130;  // M130 calls G1010
  return machine;
}

TEST(MacroCall, CyclesComeFromUserdefWithLettersByTheAlphabet) {
  TestMachine machine = machine_with_cycles();
  const Interpretation result = run(machine, "G0 A1\nG1007 X2 Z3\nG1010 H5\nM130 H6\nM30\n");
  EXPECT_THAT(stream(result),
              ElementsAre("rapid A1", "rapid X2 Z3 A1", "rapid X2 Y5 Z3 A1", "rapid X2 Y6 Z3 A1", "end 30"));
  EXPECT_EQ(result.commands[1].program, cycle_file);
  EXPECT_EQ(result.commands[1].line, 2u);
  EXPECT_EQ(ProgramName(cycle_file).view(), "USERDEF.CYC");
}

TEST(MacroCall, CyclesCallCyclesAndSubprogramsOfTheirFile) {
  TestMachine machine = machine_with_cycles();
  // The subprogram shares the variables of G1011, which has no X and Z: their words are left out.
  EXPECT_THAT(stream(run(machine, "G1011 H5\nM30\n")), ElementsAre("rapid Y6", "end 30"));
}

TEST(MacroCall, AlarmInACycleCarriesTheChainOfCalls) {
  TestMachine machine = machine_with_cycles();
  machine.programs["O0020"] = std::make_unique<StringSource>("G0 X1\nG65 P30\nM99\n");
  const Interpretation result = run(machine, "G0 X1\nX2\nM98 P20\nM30\nO30\n\nM130\nM99\n");
  // O30 is looked for in the text of O20 first, and then in a text of its own, which is not there.
  EXPECT_EQ(result.alarm.number, AlarmNumber::subprogram_missing);
  ASSERT_EQ(result.alarm.calls, 1);
  EXPECT_EQ(result.alarm.chain[0].program, 0u);
  EXPECT_EQ(result.alarm.chain[0].line, 3u);

  const Interpretation deeper = run(machine, "G0 X1\nX2\nM98 P30\nM30\nO30\n\nM130\nM99\n");
  EXPECT_EQ(deeper.alarm.number, AlarmNumber::program_alarm);
  EXPECT_EQ(deeper.alarm.program, cycle_file);
  EXPECT_EQ(deeper.alarm.line, 7u);
  ASSERT_EQ(deeper.alarm.calls, 2);
  EXPECT_EQ(deeper.alarm.chain[0].line, 3u);
  EXPECT_EQ(deeper.alarm.chain[1].line, 7u);
  EXPECT_EQ(std::string(deeper.alarm.text.data()), "alarm of the program: #3000=1(H IS MISSING)");
}

TEST(MacroCall, ACycleCalledByNameHasItsArgumentsByTheirPlace) {
  TestMachine machine;
  machine.programs["O1234"] =
      std::make_unique<StringSource>("IF [#2 EQ #0] THEN #2=40\nG0 X#1 Y#2 Z#3\nM99\n");
  EXPECT_THAT(
      stream(run(machine, "#100=7\nCYCLE1234(1,2,3)\nN20 CYCLE1234( #100+1 , , [2*3] ) (comment)\nM30\n")),
      ElementsAre("rapid X1 Y2 Z3", "rapid X8 Y40 Z6", "end 30"));
  EXPECT_THAT(stream(run(machine, "G91\nCYCLE1234()\nM30\n")), ElementsAre("rapid Y40", "end 30"))
      << "skipped arguments are vacant: their words are left out";
}

TEST(MacroCall, WhatIsSkippedOrJumpedOverMayCallCycles) {
  TestMachine machine;
  machine.programs["O1234"] = std::make_unique<StringSource>("G0 X#1\nM99\n");
  EXPECT_THAT(stream(run(machine, "GOTO 20\nCYCLE1234(1)\nN20 G0 X2\nM30\n")),
              ElementsAre("rapid X2", "end 30"));
  EXPECT_THAT(
      stream(
          run(machine, "WHILE [#1 LT 1]\n#1=1\nIF 0\nCYCLE1234(3)\nCYCLE1234(4)\nENDIF\nG0 X5\nENDW\nM30\n")),
      ElementsAre("rapid X5", "end 30"));
}

TEST(MacroCall, CYCLE9960TakesTheArgumentsOfItsSamplePrograms) {
  TestMachine machine;
  machine.programs["O9960"] =
      std::make_unique<StringSource>("IF [#2 NE #0] THEN #3000=1(TEXT)\nG0 X#1 Y#4 Z#21\nM99\n");
  EXPECT_THAT(
      stream(run(
          machine,
          "N1150 CYCLE9960(11400,\"TOOL_CARR_KIN\",1,30,0,0,180,3,0,0,0,240,3,0,0.001,2,2,1,1,0,1)\nM30\n")),
      ElementsAre("rapid X11400 Y30 Z1", "end 30"));
}

TEST(MacroCall, ANameThatIsANumberCountsInCYCLE800WhichNeedsNoBrackets) {
  TestMachine machine;
  machine.programs["O90800"] = std::make_unique<StringSource>("G0 X#1 Y#2 Z#4\nM99\n");
  EXPECT_THAT(
      stream(run(machine,
                 "CYCLE800(1,\"TABLE\",3,4)\nCYCLE800(1,\"7\",3,4)\nCYCLE800(2,\"\",3,5)\nN10 CYCLE800\n"
                 "CYCLE800 ; off\nM30\n")),
      ElementsAre("rapid X1 Z4", "rapid X1 Y7 Z4", "rapid X2 Y7 Z5", "end 30"));
}

// L and the code are arguments, too; G90 or G91 beside the code holds for the macro and behind it.
TEST(MacroCall, MacrosOfTheControlGetTheWordsOfTheirCode) {
  TestMachine machine;
  machine.programs["O90120"] = std::make_unique<StringSource>("G0 X#4 Y#10 Z#12\nM99\n");
  EXPECT_THAT(stream(run(machine, "G91 G12 I5 L3\nG0 X1\nG13 G90 I6 L4\nM30\n")),
              ElementsAre("rapid X5 Y12 Z3", "rapid X6 Y12 Z3", "rapid X6 Y13 Z4", "end 30"));
  // Distance 5 mm, feed 50 mm/min and input 1, in the units of the program.
  machine.programs["O90370"] = std::make_unique<StringSource>("G0 X#27 Y#29 Z#30\nM99\n");
  EXPECT_THAT(stream(run(machine, "G37 Z1\nM30\n")), ElementsAre("rapid X5 Y50 Z1", "end 30"));
  EXPECT_THAT(stream(run(machine, "G20 G0 X0\nG37 Z1\nM30\n")), ElementsAre("rapid X5 Y50 Z25.4", "end 30"));
}

TEST(MacroCall, WhatIsWrongWithACycleCalledByNameIsAnAlarmWithItsColumn) {
  TestMachine machine;
  machine.programs["O9960"] = std::make_unique<StringSource>("M99\n");
  const auto fault = [&](const std::string& line, AlarmNumber number, std::uint32_t column) {
    const auto result = run(machine, "G0 X1\n" + line + "\nM30\n");
    EXPECT_EQ(result.alarm.number, number) << line << ": " << result.alarm.text.data();
    EXPECT_EQ(result.alarm.line, 2u) << line;
    EXPECT_EQ(result.alarm.column, column) << line;
  };
  fault("CYCLE1234(1)", AlarmNumber::subprogram_missing, 1);
  fault("CYCLE9960(\"A\")", AlarmNumber::argument_kind, 11);
  fault("CYCLE9960(1,2)", AlarmNumber::argument_kind, 13);
  fault("CYCLE9960(1,\"A\",3,\"B\")", AlarmNumber::argument_kind, 19);
  fault("CYCLE9960(1,\"A\",3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22)",
        AlarmNumber::too_many_arguments, 67);
  fault("CYCLE9960(1,\"A)", AlarmNumber::bracket_open, 13);
  fault("CYCLE9960(1,", AlarmNumber::bracket_open, 13);
  fault("CYCLE9960(1 2)", AlarmNumber::bracket_open, 13);
  fault("CYCLE9960(1", AlarmNumber::bracket_open, 12);
  fault("CYCLE9960", AlarmNumber::operand_missing, 10);
  fault("CYCLEX(1)", AlarmNumber::unknown_instruction, 1);
  fault("CYCLE9960(1) X1", AlarmNumber::text_behind_statement, 14);
  fault("G1 CYCLE9960(1)", AlarmNumber::statement_not_first, 4);
}

TEST(MacroCall, ExampleOfEveryCallCodeIsAcceptedAndOtherNumbersAreRefused) {
  TestMachine machine = machine_with_cycles();
  for (const CallCode& code : call_codes) {
    const Interpretation result = run(machine, code.example);
    EXPECT_EQ(result.last, Step::end) << code.example << ": " << result.alarm.text.data();
    const std::string name = std::to_string(code.first / 10) + (code.first % 10 != 0 ? "." : "");
    EXPECT_NE(std::string(code.example).find("G" + name.substr(0, 2)), std::string::npos);
    EXPECT_STRNE(code.meaning, "");
  }
  const auto called = [](std::uint32_t tenths) {
    for (const CallCode& code : call_codes) {
      const bool fits = code.kind != CallKind::cycle || tenths % 10 == 0;
      if (fits && tenths >= code.first && tenths <= code.last) return true;
    }
    return false;
  };
  // Every G to G2100 in steps of a tenth: what no table names is unknown, and nothing else is.
  for (std::uint32_t tenths = 0; tenths <= 21000; ++tenths) {
    const bool known = g_code(tenths) != nullptr || called(tenths);
    const std::string number = std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
    const Interpretation result = run(machine, "G" + number + "\n");
    const bool refused =
        result.alarm.number == AlarmNumber::unknown_g || result.alarm.number == AlarmNumber::foreign_word;
    EXPECT_EQ(refused, !known) << "G" << number;
  }
}

TEST(MacroCall, ChainOfCallsIsTheSameFromATextThatComesInPieces) {
  struct Pieces : TextSource {
    ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
      asked = !asked;
      if (asked) return {ReadStatus::pending, 0};
      return whole.read(offset, buffer, std::min<std::size_t>(capacity, 3));
    }
    StringSource whole{"G0 X1\nM98 P5\nM30\n(....................)\nO5\nG77\nM99\n"};
    bool asked = false;
  };
  TestMachine machine;
  Pieces text;
  const Interpretation result = run(machine, text);
  EXPECT_EQ(result.alarm.line, 6u);
  ASSERT_EQ(result.alarm.calls, 1);
  EXPECT_EQ(result.alarm.chain[0].line, 2u);
}

TEST(MacroCall, RecursionIsAnAlarmAtTheNinthLevel) {
  TestMachine machine = machine_with_cycles();
  for (const char* program : {"M98 P5\nM30\nO5\nM98 P5\nM99", "G65 P5 A1\nM30\nO5\nG65 P5 A#1\nM99"}) {
    const Interpretation result = run(machine, program);
    EXPECT_EQ(result.alarm.number, AlarmNumber::nesting_too_deep);
    EXPECT_EQ(result.alarm.calls, max_nesting);
    EXPECT_EQ(result.alarm.chain[0].line, 1u);
    EXPECT_EQ(result.alarm.chain[7].line, 4u);
  }
}

TEST(MacroCall, ModalCallOfAMissingProgramIsAnAlarmWhereItIsCalled) {
  TestMachine machine;
  const Interpretation result = run(machine, "G66 P10\nG0 X1\n");
  EXPECT_THAT(stream(result), ElementsAre("rapid X1", "alarm 1401 2:1"));
}

// The newest call is made at the move of the main program, the one before it at each move of that macro; G67
// ends the newest.
TEST(MacroCall, ModalCallsNest) {
  TestMachine machine;
  const Interpretation result = run(machine,
                                    "G66 P1 A7\nG66 P2 B5\nG0 X1\nG67\nX2\nG67\nX3\nM30\n"
                                    "O1\nG91\nG0 Z#1\nG90\nM99\nO2\nG0 Y#2\nY[#2+1]\nM99\n");
  EXPECT_THAT(stream(result),
              ElementsAre("rapid X1", "rapid X1 Y5", "rapid X1 Y5 Z7", "rapid X1 Y6 Z7", "rapid X1 Y6 Z14",
                          "rapid X2 Y6 Z14", "rapid X2 Y6 Z21", "rapid X3 Y6 Z21", "end 30"));
}

TEST(MacroCall, AModalCallInAMacroEndsWithoutThoseOfItsCallers) {
  TestMachine machine;
  const Interpretation result = run(machine,
                                    "G66 P2\nG0 X1\nX2\nG67\nX3\nM30\n"
                                    "O1\nG91\nG0 Z1\nG90\nM99\nO2\nG66 P1\nG91\nG0 Y1\nG90\nG67\nM99\n");
  EXPECT_THAT(stream(result), ElementsAre("rapid X1", "rapid X1 Y1", "rapid X1 Y1 Z1", "rapid X2 Y1 Z1",
                                          "rapid X2 Y2 Z1", "rapid X2 Y2 Z2", "rapid X3 Y2 Z2", "end 30"));
}

TEST(MacroCall, MoreModalCallsThanMayNestAreAnAlarm) {
  TestMachine machine;
  const Interpretation result = run(machine, "G66 P1\nG66 P1\nG66 P1\nG66 P1\nG66 P1\n");
  EXPECT_EQ(result.alarm.number, AlarmNumber::nesting_too_deep);
  EXPECT_EQ(result.alarm.line, 5u);
}

}  // namespace
}  // namespace trunnion::language::test
