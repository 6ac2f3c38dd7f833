// SPDX-License-Identifier: Apache-2.0
// Codes that call programs by parameter, and the forms of M98.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test::code_calls {
namespace {

using testing::ElementsAre;

TestMachine machine_that_calls() {
  TestMachine machine;
  machine.calls.g = {150, 4};             // G150 calls O9010, G4 O9011
  machine.calls.m = {6, 0, 70};           // M6 calls O9020, M70 O9022
  machine.calls.m_subprograms = {0, 60};  // M60 calls O9002
  machine.programs["O9010"] = std::make_unique<StringSource>("G0 X#24 Y#16 Z#13\nM99\n");
  machine.programs["O9011"] = std::make_unique<StringSource>("G0 X#24\nM99\n");
  machine.programs["O9020"] = std::make_unique<StringSource>("T#20 M6\nG150 X1\nM99\n");
  machine.programs["O9022"] = std::make_unique<StringSource>("IF [#13 NE #0] THEN #3000=1\nG0 X#1\nM99\n");
  machine.programs["O9002"] = std::make_unique<StringSource>("M98 P20\nM99\n");
  machine.programs["O0020"] = std::make_unique<StringSource>("M60\nG4 P1000\nM99\n");
  machine.programs["O9000"] = std::make_unique<StringSource>("G0 X#149\nT#149\nM99\n");
  machine.programs["O9029"] = std::make_unique<StringSource>("S#147\nM99\n");
  return machine;
}

TEST(CodeCalls, AGCodeCallsItsMacroWithTheLettersAsArguments) {
  TestMachine machine = machine_that_calls();
  EXPECT_THAT(stream(run(machine, "G150 X1 P2 M3\nG150 X5 L2\nM30\n")),
              ElementsAre("rapid X1 Y2 Z3", "rapid X5 Y2 Z3", "end 30"));
}

TEST(CodeCalls, ACodeOfTheTableIsReplacedWhereAParameterSaysSo) {
  TestMachine machine = machine_that_calls();
  EXPECT_THAT(stream(run(machine, "G4 X3\nM30\n")), ElementsAre("rapid X3", "end 30"));
  machine.calls.g = {};
  EXPECT_THAT(stream(run(machine, "G4 X3\nM30\n")), ElementsAre("dwell 3", "end 30"));
}

TEST(CodeCalls, InACalledProgramEveryCodeIsTheOrdinaryOneAtAnyDepth) {
  TestMachine machine = machine_that_calls();
  machine.calls.g = {150};
  EXPECT_EQ(run(machine, "T7 M6\nM30\n").alarm.number, AlarmNumber::foreign_word) << "G150 in O9020";
  machine.programs["O9020"] = std::make_unique<StringSource>("T#20 M6\nM99\n");
  EXPECT_THAT(stream(run(machine, "T7 M6\nM30\n")), ElementsAre("T7", "M6", "end 30"));
  // O9002 calls O0020, whose M60 and G4 are those of the PLC and of the table.
  machine.calls.g = {4};
  EXPECT_THAT(stream(run(machine, "M60\nM30\n")), ElementsAre("M60", "dwell 1", "end 30"));
}

TEST(CodeCalls, AnMCodeOfAMacroIsNoArgumentOfIt) {
  TestMachine machine = machine_that_calls();
  EXPECT_THAT(stream(run(machine, "M70 A4\nM30\n")), ElementsAre("rapid X4", "end 30"));
}

TEST(CodeCalls, WhatIsBesideTheCodeOfASubprogramComesBeforeIt) {
  TestMachine machine = machine_that_calls();
  machine.programs["O9002"] = std::make_unique<StringSource>("#100=#100+1\nX[10*#100]\nM99\n");
  EXPECT_THAT(stream(run(machine, "G0 X1 M8 M60\nM60\nM30\n")),
              ElementsAre("M8", "rapid X1", "rapid X10", "rapid X20", "end 30"));
}

TEST(CodeCalls, TAndSHandTheirNumbersToTheirSubprograms) {
  TestMachine machine = machine_that_calls();
  machine.calls.m = {};
  machine.calls.t = machine.calls.s = true;
  EXPECT_THAT(stream(run(machine, "T5 Y2 G0\nS300\nM30\n")),
              ElementsAre("rapid Y2", "rapid X5 Y2", "T5", "S300", "end 30"));
}

TEST(CodeCalls, NothingElseIsCalledInTheBlock) {
  TestMachine machine = machine_that_calls();
  machine.calls.t = true;
  for (const char* line : {"G0 G150 X1", "G150 M3 M8", "G90 M70", "M70 M8", "M60 M98 P20", "M60 M30",
                           "M60 T1", "G66 P9011 X1\nM60"}) {
    const auto result = run(machine, std::string(line) + "\nM30\n");
    EXPECT_EQ(result.alarm.number, AlarmNumber::call_not_alone) << line << ": " << result.alarm.text.data();
  }
  machine.programs.erase("O9010");
  EXPECT_EQ(run(machine, "G150 X1\n").alarm.number, AlarmNumber::subprogram_missing);
}

TEST(CodeCalls, TheProgramsOfTheNumDialectHaveNone) {
  TestMachine machine = machine_that_calls();
  machine.dialect = ProgramDialect::num;
  EXPECT_THAT(stream(run(machine, "%1\nM60\nM02\n")), ElementsAre("M60", "end 2"));
}

// The codes are the numbers that the program has: G77 is G87 of the table, G47 no code, and G112 not here.
TEST(CodeCalls, OfHaasProgramsAreTheirOwnNumbers) {
  TestMachine machine = machine_that_calls();
  machine.dialect = ProgramDialect::haas;
  machine.calls.g = {112, 47, 77};
  machine.calls.m = {96};
  machine.programs["O9012"] = std::make_unique<StringSource>("(DIALECT: ISO)\nG0 X#24\nM99\n");
  machine.programs["O9020"] = std::make_unique<StringSource>("X9.\nM99\n");
  EXPECT_THAT(stream(run(machine, "G112 X1. P2\nG47 X3.\nG77 X4.\nM96\nM30\n")),
              ElementsAre("rapid X1 Y2", "rapid X3 Y2", "rapid X4 Y2", "rapid X9 Y2", "end 30"));
  EXPECT_EQ(run(machine, "M3 S9\nG87 Z-1. R1. F100.\n").alarm.number, AlarmNumber::none)
      << "G88 of the table";
  EXPECT_EQ(run(machine, "G113\n").alarm.number, AlarmNumber::haas_function_missing);
  EXPECT_EQ(run(machine, "M60 G36\n").alarm.number, AlarmNumber::haas_function_missing);
}

TEST(SubprogramCall, BeginsAtASequenceNumberInEachRepetition) {
  TestMachine machine;
  machine.programs["O0020"] =
      std::make_unique<StringSource>("%\n(A COMMENT)\nO0020 (PART)\nG0 X1\nN5 X2\nN7 G91 X3\nG90\nM99\n");
  EXPECT_THAT(stream(run(machine, "M98 P20 H5\nM98 P20 Q7 L2\nM98 P20\nM30\n")),
              ElementsAre("rapid X2", "rapid X5", "rapid X8", "rapid X11", "rapid X1", "rapid X2", "rapid X5",
                          "end 30"));
  EXPECT_THAT(stream(run(machine, "G0 Y1\nM98 P30 H1\nM30\nO30\nX9\nN1 X4\nM99\nO31\nN2 X5\nM99\n")),
              ElementsAre("rapid Y1", "rapid X4 Y1", "end 30"));
}

TEST(SubprogramCall, QAloneIsASequenceNumberOfThisProgram) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G0 Y1\nM98 Q20 L2\nX3\nM30\nN20 G91 X1\nG90\nM99\n")),
              ElementsAre("rapid Y1", "rapid X1 Y1", "rapid X2 Y1", "rapid X3 Y1", "end 30"));
  EXPECT_EQ(run(machine, "M98 Q20 H5\nM30\nN20 X1\nN5 M99\n").alarm.number, AlarmNumber::unused_word);
  const auto result = run(machine, "M98 Q20\nM30\nO30\nN20 X1\nM99\n");
  EXPECT_EQ(result.alarm.number, AlarmNumber::label_missing);
  EXPECT_EQ(result.alarm.column, 5u);
}

TEST(SubprogramCall, ASequenceNumberOfAnotherProgramIsNotOfThisOne) {
  TestMachine machine;
  const auto result = run(machine, "G0 Y1\nM98 P30 H2\nM30\nO30\nX9\nM99\nO31\nN2 X5\nM99\n");
  EXPECT_EQ(result.alarm.number, AlarmNumber::label_missing);
  EXPECT_EQ(result.alarm.line, 2u);
  EXPECT_EQ(result.alarm.column, 9u);
  EXPECT_EQ(run(machine, "M98 P30 H2\nM30\nO30\nIF [1]\nN2 X5\nENDIF\nM99\n").alarm.number,
            AlarmNumber::jump_into_structure);
}

TEST(SubprogramCall, HIsTheLengthBesideG43AndTheSequenceNumberOtherwise) {
  TestMachine machine;
  machine.lengths = {{1, 50}, {5, 70}};
  machine.programs["O0020"] = std::make_unique<StringSource>("G0 X1\nN5 X2\nM99\n");
  EXPECT_THAT(stream(run(machine, "G43 H1\nM98 P20 H5\nM30\n")),
              ElementsAre("frame none L50", "rapid X2", "end 30"));
  EXPECT_THAT(stream(run(machine, "G43 H1 M98 P20\nM30\n")),
              ElementsAre("frame none L50", "rapid X1", "rapid X2", "end 30"));
}

TEST(SubprogramCall, L0CallsNothingAndM198CallsAsM98) {
  TestMachine machine;
  machine.programs["O0020"] = std::make_unique<StringSource>("G91 G0 X1\nG90\nM99\n");
  EXPECT_THAT(stream(run(machine, "M98 P20 L0\nM198 P20 L2\nM30\n")),
              ElementsAre("rapid X1", "rapid X2", "end 30"));
}

}  // namespace
}  // namespace trunnion::language::test::code_calls
