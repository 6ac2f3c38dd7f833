// SPDX-License-Identifier: Apache-2.0
// Programs of NUM 1020 to 1060 T controls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "language/num_codes.hpp"
#include "language/num_parameters.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

TestMachine num_machine() {
  TestMachine machine;
  machine.dialect = ProgramDialect::num;
  return machine;
}

std::vector<std::string> num_stream(const std::string& program) {
  TestMachine machine = num_machine();
  return stream(run(machine, program));
}

TEST(NumDialect, WordsNeedNoBlanksAndComeInAnyOrder) {
  EXPECT_THAT(num_stream("M64M40M3S50\nG1X1.5Y-2F100(corner)\nz3 g0 $ up\nM2\n"),
              ElementsAre("M64", "S50", "M40", "M3", "line X1.5 Y-2 F100", "message 10000",
                          "rapid X1.5 Y-2 Z3", "end 2"));
}

TEST(NumDialect, AssignmentsAndWordsAreInOneBlock) {
  // L100 = 2 * 3 - 1 = 5.
  EXPECT_THAT(num_stream("L0=2 L100=L0*3-1 G1 F100 XL0 Y-L100\nM2"),
              ElementsAre("line X2 Y-5 F100", "end 2"));
  EXPECT_THAT(num_stream("E80000 = 3 E80001=42\nL0=200\nME80000 SL0\nM2"),
              ElementsAre("S200", "M3", "end 2"));
  // A variable that was never written is 0.
  EXPECT_THAT(num_stream("X4\nXL7 Y1\nM2"), ElementsAre("rapid X4", "rapid Y1", "end 2"));
}

TEST(NumDialect, ExpressionsGoFromLeftToRight) {
  // 2 * 3 + 4 = 10; 7 / 2 = 3.5; 10 - 2 - 3 = 5; -(-4) through a variable.
  EXPECT_THAT(num_stream("L1=2*3+4 L2=7/2 L3=10-2-3 L4=-4\nXL1 YL2 ZL3 A-L4\nM2"),
              ElementsAre("rapid X10 Y3.5 Z5 A4", "end 2"));
  EXPECT_THAT(num_stream("E80000=1500\nE80000=-E80000\nXE80000\nM2"), ElementsAre("rapid X-1500", "end 2"));
}

TEST(NumDialect, ConditionsChooseABranch) {
  EXPECT_THAT(num_stream("L0=1\nIF L0=1 THEN (one)\nX1\nELSE\nX2\nENDI\n"
                         "IF L0<>1 THEN\nX3\nELSE (another)\nX4\nENDI\nM2"),
              ElementsAre("rapid X1", "rapid X4", "end 2"));
  for (const char* holds : {"2=2", "2<>3", "2<3", "3>2", "2<=2", "2>=2", "L0=0", "-1<L0"})
    EXPECT_THAT(num_stream(std::string("IF ") + holds + " THEN X1\nENDI\nM2"),
                ElementsAre("rapid X1", "end 2"))
        << holds;
  for (const char* fails : {"2=3", "2<>2", "3<2", "2>3", "3<=2", "2>=3", "L0=1"})
    EXPECT_THAT(num_stream(std::string("IF ") + fails + " THEN X1\nELSE\nX2\nENDI\nM2"),
                ElementsAre("rapid X2", "end 2"))
        << fails;
}

TEST(NumDialect, ALoopRepeatsTheWordsBehindItsDo) {
  EXPECT_THAT(num_stream("L0=0\nWHILE L0<3 DO L0=L0+1 XL0\nENDW\nM2"),
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "end 2"));
  EXPECT_THAT(num_stream("WHILE L0=0 DO G4 F.5 $wait\nL0=1\nENDW\nM2"),
              ElementsAre("message 10000", "dwell 0.5", "end 2"));
}

TEST(NumDialect, JumpsAreConditional) {
  EXPECT_THAT(num_stream("G79 N30\nX1\nN30 Y1\nM2"), ElementsAre("rapid Y1", "end 2"));
  EXPECT_THAT(num_stream("N10 L0=L0+1 XL0\nG79 L0<3 N10\nM2"),
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "end 2"));
}

TEST(NumDialect, MessagesAreThoseOfTheirLine) {
  TestMachine machine = num_machine();
  const Interpretation result = run(machine, "$HELLO \xe9\nX1 $MOVE\n$\nX2$  \nM2");
  EXPECT_THAT(stream(result), ElementsAre("message 10000", "message 10000", "rapid X1", "rapid X2", "end 2"));
  EXPECT_EQ(result.commands[0].line, 1u);
  EXPECT_EQ(result.commands[1].line, 2u);
}

TEST(NumDialect, DwellIsInSecondsAndUnitsAreG70AndG71) {
  EXPECT_THAT(num_stream("G4 F.5\nG4F1\nM2"), ElementsAre("dwell 0.5", "dwell 1", "end 2"));
  // 1 inch = 25.4 mm, 10 inch/min = 254 mm/min.
  EXPECT_THAT(num_stream("G70 G1 X1 F10\nG71 X1\nM2"),
              ElementsAre("line X25.4 F254", "line X1 F254", "end 2"));
}

TEST(NumDialect, ModalFunctionsAreReadByTheirGroup) {
  EXPECT_THAT(num_stream("L0=[.RG80] L1=[.RG71] L2=[.RG0] L3=[.RG91]\nXL0 YL1 ZL2 AL3\nM2"),
              ElementsAre("rapid X80 Y71 A90", "end 2"));
  EXPECT_THAT(num_stream("G70 G1 G18 G95 F1\nL0=[.RG71] L1=[.RG3] L2=[.RG17] L3=[.RG94]\n"
                         "G71 G0 XL0 YL1 ZL2 AL3\nM2"),
              ElementsAre("rapid X70 Y1 Z18 A95", "end 2"));
}

TEST(NumDialect, ACalledProgramEndsWithItsText) {
  // The head behind it ends it; it shares the variables of its caller.
  EXPECT_THAT(num_stream("%1 (MAIN)\nL0=5 G77 H20.1\nY1 XL0\nM2\n%20\nX9\n%20.1\nXL0\nL0=7\n%30\nX8\n"),
              ElementsAre("rapid X5", "rapid X7 Y1", "end 2"));
  EXPECT_THAT(num_stream("WHILE L0<2 DO G77 H5\nENDW\nM2\n%5\nL0=L0+1 XL0\n"),
              ElementsAre("rapid X1", "rapid X2", "end 2"));
  TestMachine machine = num_machine();
  machine.programs["O9990.9"] = std::make_unique<StringSource>("XL0 M2\nX99\n");
  EXPECT_THAT(stream(run(machine, "L0=2 F2000 G77 H9990.9(axe Z)\nG1 Z1\nM2")),
              ElementsAre("rapid X2", "line X2 Z1 F2000", "end 2"));
  machine.programs["O0005"] = std::make_unique<StringSource>("IF 1=1 THEN\nX1\n");
  EXPECT_THAT(stream(run(machine, "G77 H5\nM2")), ElementsAre("rapid X1", "alarm 1405 1:1"));
}

TEST(NumDialect, ProgramsAreStoredUnderTheirNumber) {
  EXPECT_EQ(ProgramName(900009990).view(), "O9990.9");
  EXPECT_EQ(ProgramName(100000020).view(), "O0020.1");
  EXPECT_EQ(ProgramName(99999999).view(), "O99999999");
}

TEST(NumDialect, VariablesAreThoseOfTheControl) {
  TestMachine machine = num_machine();
  StringSource source("L100=4 L199=5 E80000=-6 E80050=7\nM2");
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  Command command;
  EXPECT_EQ(interpreter.next(command), Step::command);
  const VariableStore& store = interpreter.variables();
  // #50 is the first of common, #500 that of kept.
  EXPECT_EQ(store.common[100 - 50].number, 4);
  EXPECT_EQ(store.common[199 - 50].number, 5);
  EXPECT_EQ(store.kept[900 - 500].number, -6);
  EXPECT_EQ(store.kept[950 - 500].number, 7);
}

TEST(NumDialect, ExternalParametersComeFromTheMachineByNumberOrMnemonic) {
  TestMachine machine = num_machine();
  machine.external = {{90330, 20000}, {90373, 1500}};
  EXPECT_THAT(stream(run(machine, "XE90330 YE[ACCB1]\nL0=E[n_cmaxb4]/2 ZL0\nM2")),
              ElementsAre("rapid X20000 Y20000", "rapid X20000 Y20000 Z750", "end 2"));
  ASSERT_TRUE(external_parameter("MODULOB4").has_value());
  EXPECT_EQ(external_parameter("MODULOB4")->number(), 90113u);
  EXPECT_EQ(external_parameter("MESPOSBG")->number(), 79000u);
  EXPECT_STREQ(external_parameter(93527u)->name(), "POS_B4 (E93527)");
  EXPECT_FALSE(external_parameter(90114u).has_value());
  EXPECT_FALSE(external_parameter("MODULOB").has_value());
  EXPECT_FALSE(external_parameter("1").has_value());
}

TEST(NumDialect, TablesAreInOrderAndFitTheAlarm) {
  for (std::size_t i = 1; i < num_codes.size(); ++i)
    EXPECT_TRUE(num_codes[i - 1].number < num_codes[i].number ||
                (num_codes[i - 1].number == num_codes[i].number && num_codes[i].plus));
  for (const NumCode& code : num_codes) EXPECT_LE(std::string(code.meaning).size(), 48u) << code.number;
  for (std::size_t i = 1; i < external_parameters.size(); ++i)
    EXPECT_LT(external_parameters[i - 1].first + external_parameters[i - 1].count - 1,
              external_parameters[i].first);
}

struct NumFault {
  AlarmNumber number;
  const char* program;
  std::uint32_t line;
  std::uint32_t column;
  const char* word;
};

const std::vector<NumFault>& num_faults() {
  using enum AlarmNumber;
  static const std::vector<NumFault> faults = {
      {num_g_unknown, "X1\nG54", 2, 1, ": G54"},
      {num_g_unknown, "G41 X1", 1, 1, ": G41"},
      {num_g_unknown, "G4+ F1", 1, 1, ": G4+"},
      {num_g_unknown, "G65 A1", 1, 1, ": G65"},
      {num_m_unknown, "M30", 1, 1, ": M30"},
      {num_m_unknown, "L0=99 ML0", 1, 7, ": ML"},
      {num_wait_mark, "G78 Q1 P1.2", 1, 1, ": G78"},
      {num_function_missing, "G84 Z-200 K1.25 EK2.5 M5", 1, 1, ": G84, rigid tapping"},
      {num_function_missing, "G38 K2 Z-13", 1, 1, ": G38, thread cutting"},
      {num_function_missing, "G38+ J-18 EC90 K2 Z-13", 1, 1, ": G38+, resumed thread cutting"},
      {num_function_missing, "G33 Z-13 K2", 1, 1, ": G33, thread cutting cycle"},
      {num_function_missing, "M64 G39+ M3 M41 S200 K1.2 W10", 1, 5, ": G39+, rigid tap removal"},
      {num_function_missing, "F2000 G159 C", 1, 7, ": G159, homing by program"},
      {num_function_missing, "EZ-L0", 1, 1, ": EZ, resumed thread cutting"},
      {num_word, "G2 X1 I1", 1, 7, ": I1"},
      {num_word, "D1", 1, 1, ": D1"},
      {num_word, "O1234", 1, 1, ": O1234"},
      {num_word, "G1 N5", 1, 4, ": N5"},
      {num_word, "H5", 1, 1, ": H5"},
      {num_word, "G77 H5 S2", 1, 8, ": S2"},
      {num_word, "G4 F1 X2", 1, 7, ": X2"},
      {num_parameter_unknown, "L0=E12345", 1, 4, ": E12345"},
      {num_parameter_unknown, "L0=E[FOO]", 1, 4, ": E"},
      {num_parameter_unknown, "L0=E[MUCHTOOLONG]", 1, 4, ": E"},
      {num_parameter_unavailable, "L0=E90110", 1, 4, ": E90110, MODULOB1 (E90110)"},
      {num_parameter_unavailable, "E90300=24", 1, 1, ": E90300, VITPALB1 (E90300)"},
      {num_parameter_unavailable, "E98024=500", 1, 1, ": E98024, TIB1 (E98024)"},
      {num_parameter_unavailable, "E35324 = 0", 1, 1, ": E35324"},
      {value_range, "M4 EC400", 1, 4, ": EC, the angle is -360 to 360 deg"},
      {variable_value, "E91024=1", 1, 1, ": E91024, 0: speed control"},
      {variable_value, "E94125=25", 1, 1, ": E94125, another spindle"},
      {spindle_without_mark, "E94125=24", 1, 1, ": E94125, spindle 1"},
      {num_operation_order, "L1=2+3*4", 1, 7, ": *"},
      {num_modal_read, "L0=[.RG4]", 1, 4, ": ["},
      {num_modal_read, "L0=[2]", 1, 4, ": ["},
      {variable_read_only, "E90100=1", 1, 1, ": E90100, MESPOSB1 (E90100)"},
      {variable_value, "E80000=1.5", 1, 1, ": E80000, a whole number"},
      {variable_unknown, "L20=1", 1, 1, ": L20, L0 to L19 and L100 to L199"},
      {letter_twice, "X1 X2", 1, 4, ": X2"},
      {missing_word, "G4", 1, 1, ": G4, needs F"},
      {missing_word, "G77", 1, 1, ": G77, needs H"},
      {missing_word, "G79 L0=1", 1, 1, ": G79, needs N"},
      {value_range, "G77 H0.5", 1, 5, ": H0.5"},
      {not_an_integer, "G77 H1.25", 1, 5, ": H1.25"},
      {subprogram_missing, "G77 H9990.9", 1, 5, ": H9990.9"},
      {label_missing, "G79 N9", 1, 1, ": G79, N9"},
      {operand_missing, "L0", 1, 3, ", needs ="},
      {operand_missing, "IF L0 THEN", 1, 7, ": THEN, needs = <> < > <= or >="},
      {operand_missing, "IF 1=1 G0", 1, 8, ": G0, needs THEN"},
      {operand_missing, "WHILE 1=1", 1, 10, ", needs DO"},
      {statement_not_first, "G0 IF 1=1 THEN", 1, 4, ": IF"},
      {statement_not_first, "G0 G79 N1", 1, 4, ": G79"},
      {text_behind_statement, "IF 1=1 THEN\nENDI X1", 2, 6, ": X1"},
      {text_behind_statement, "IF 1=1 THEN\nELSE $text", 2, 6, ": $"},
      {end_without_begin, "ENDW", 1, 1, ": ENDW"},
      {number_missing, "%\nX1", 1, 1, ": %"},
      {misplaced_head, "M64M40M3S50%", 1, 12, ": %"},
      {unknown_instruction, "GOTO 5", 1, 1, ": GOTO"},
      {unknown_character, "#1=2", 1, 1, ": #1"},
      {open_comment, "X1 (open", 1, 4, ": ("},
  };
  return faults;
}

TEST(NumDialect, RefusesByNameWhatIsNotThere) {
  for (const NumFault& wrong : num_faults()) {
    SCOPED_TRACE(wrong.program);
    TestMachine machine = num_machine();
    const Interpretation result = run(machine, wrong.program);
    ASSERT_EQ(result.last, Step::alarm);
    EXPECT_EQ(result.alarm.line, wrong.line);
    EXPECT_EQ(result.alarm.column, wrong.column);
    EXPECT_EQ(std::string(result.alarm.text.data()), std::string(alarm_text(wrong.number)) + wrong.word);
  }
}

TEST(NumDialect, EveryAlarmOfItHasATest) {
  std::set<AlarmNumber> tested;
  for (const NumFault& wrong : num_faults()) tested.insert(wrong.number);
  for (const AlarmText& entry : alarm_texts) {
    const auto number = static_cast<int>(entry.number);
    if (number >= 1150 && number <= 1199) {
      EXPECT_TRUE(tested.contains(entry.number)) << entry.text;
    }
  }
}

// The same text means another thing in the other dialect, or nothing.
TEST(NumDialect, ClashesAreDecidedByTheDialect) {
  TestMachine iso, num = num_machine();
  const auto alarm = [](TestMachine& machine, const char* text) { return run(machine, text).alarm.number; };
  EXPECT_EQ(alarm(iso, "$text"), AlarmNumber::unknown_character);
  EXPECT_EQ(alarm(num, "$text"), AlarmNumber::none);
  EXPECT_EQ(alarm(iso, "%\nG0 X1\n%\n"), AlarmNumber::none);
  EXPECT_EQ(alarm(num, "%\nG0 X1\n%\n"), AlarmNumber::number_missing);
  EXPECT_EQ(alarm(iso, "G4 F1"), AlarmNumber::missing_word);
  EXPECT_EQ(alarm(num, "G4 F1"), AlarmNumber::none);
  EXPECT_EQ(alarm(iso, "G4 P100"), AlarmNumber::none);
  EXPECT_EQ(alarm(num, "G4 P100"), AlarmNumber::num_word);
  EXPECT_EQ(alarm(iso, "G77 H5"), AlarmNumber::unknown_g);
  EXPECT_EQ(alarm(num, "G77 H5"), AlarmNumber::subprogram_missing);
  EXPECT_EQ(alarm(iso, "G95 S100 G84 Z-4 R1 F1 K2"), AlarmNumber::none);
  EXPECT_EQ(alarm(num, "G95 S100 G84 Z-4 ER1 K2"), AlarmNumber::num_function_missing);
  EXPECT_TRUE(run(iso, "G70").modal.metric);
  EXPECT_FALSE(run(num, "G70").modal.metric);
  // M40 goes to the PLC in both.
  EXPECT_THAT(stream(run(iso, "M40\nM2")), ElementsAre("M40", "end 2"));
  EXPECT_THAT(stream(run(num, "M40\nM2")), ElementsAre("M40", "end 2"));
}

TEST(NumDialect, ADialectThatIsNamedGoesBeforeThatOfTheMachine) {
  TestMachine machine;
  StringSource source("G4 F2\nM2");
  Interpreter interpreter(machine, {}, &Interpreter::dialect_of(ProgramDialect::num));
  interpreter.start(source, {}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::dwell);
  EXPECT_EQ(command.dwell_seconds, 2);
}

// Homing of a machine with one group and of one group of two; the call of an axis moves X to its number here.
TEST(NumDialect, ProgramsOfTheManualRunUpToWhatIsNotThere) {
  TestMachine machine = num_machine();
  machine.programs["O9990.9"] = std::make_unique<StringSource>("XL0\n");
  EXPECT_THAT(
      stream(run(machine,
                 "$9990\nIF [.RG80] = 159 THEN (called by G159)\n   G77 H9990.9\n\nELSE (called in "
                 "homing mode)\n        (perhaps a feed)\n   L0=2 F2000 G77 H9990.9 (Z)\n   L0=0 F3000 "
                 "G77 H9990.9 (X)\n   L0=1 G77 H9990.9 (Y)\n   L0=8 F10000 G77 H9990.9 (C)\nM2\n")),
      ElementsAre("message 10000", "rapid X2", "rapid", "rapid X1", "rapid X8", "end 2"));
  EXPECT_THAT(stream(run(machine,
                         "%9990.1 (HOMING, GROUP 1)\nIF [.RG80] = 159 THEN (called by G159)\n   G77 "
                         "H9990.9\nELSE\n   L0=2 F2000 G77 H9990.9(Z)\n   G78 Q1 P1.2 (WAIT)\n   M2\n"
                         "%9990.2(HOMING, GROUP 2)\n")),
              ElementsAre("rapid X2", "alarm 1152 6:4"));
  EXPECT_THAT(stream(run(machine, "E80000=3 E80001=42\nL0=200 L1=1.25\nG39+ ME80000 ME80001 SL0 KL1 Z-10\n")),
              ElementsAre("alarm 1153 3:1"));
  EXPECT_THAT(stream(run(machine, "E35324 = 0\n")), ElementsAre("alarm 1156 1:1"));
  EXPECT_THAT(stream(run(machine,
                         "WHILE L0=0 DO G4 F.5 $\nL0=1\nENDW\n$SYNCHRO OK\nM64 M40 M3 S2000\nG4 F5\n"
                         "M2\n")),
              ElementsAre("dwell 0.5", "message 10000", "M64", "S2000", "M40", "M3", "dwell 5", "end 2"));
}

// The values that the program asks for, one after the other; 0 when there are no more.
std::vector<std::string> with_values(Environment& machine, const std::string& text,
                                     std::vector<double> values, InterpreterOptions options = {}) {
  StringSource source(text);
  Interpreter interpreter(machine, options);
  interpreter.start(source, {}, {});
  Interpretation result;
  Command command;
  std::size_t next = 0;
  do {
    result.last = interpreter.next(command);
    if (result.last == Step::command) result.commands.push_back(command);
    if (result.last != Step::value) continue;
    EXPECT_EQ(result.commands.back().kind, CommandKind::read);
    EXPECT_EQ(interpreter.next(command), Step::value) << "nothing is read before the value";
    interpreter.give_value(next < values.size() ? values[next] : 0);
    ++next;
  } while (result.last != Step::end && result.last != Step::alarm && result.commands.size() < 1000);
  result.alarm = interpreter.alarm();
  EXPECT_GE(next, values.size()) << "it has asked for fewer";
  return stream(result);
}

// Command::number is 8 times the place of the value in SpindleValue and the spindle: homed 0, synchronized 8,
// master 16, error 24, reference 32, angle 40.
TEST(NumSpindles, ALoopReadsTheStateAgainEachTime) {
  TestMachine machine = num_machine();
  EXPECT_THAT(with_values(machine, "WHILE E93525=0 DO G4 F.5 $\nENDW\nX1\nM2", {0, 0, 1}),
              ElementsAre("read 9", "dwell 0.5", "read 9", "dwell 0.5", "read 9", "rapid X1", "end 2"));
  EXPECT_THAT(with_values(machine, "WHILE E91124=1 DO $Homing\nM64M40M3S50\nENDW\nM2", {0, 1}),
              ElementsAre("read 0", "message 10000", "M64", "S50", "M40", "M3", "read 0", "end 2"));
}

// 90 deg of 360 are 25000 of 100000 and 16384 of 65536; master 2 is address 24 + 1.
TEST(NumSpindles, ValuesAreInTheUnitsOfTheParameters) {
  TestMachine machine = num_machine();
  EXPECT_THAT(
      with_values(machine, "XE90100\nYE95224\nZE90200\nAE94125\nM2", {90, -90, -1500, 2}),
      ElementsAre("read 40", "rapid X25000", "read 24", "rapid X25000 Y-16384", "read 32",
                  "rapid X25000 Y-16384 Z-1500", "read 17", "rapid X25000 Y-16384 Z-1500 A25", "end 2"));
  EXPECT_THAT(with_values(machine, "XE94125 YE[POM_B1]\nM2", {0, 1}),
              ElementsAre("read 17", "read 0", "rapid X-1", "end 2"));
}

// Without the taking back L0 would be 3 and L2 4 behind two values.
TEST(NumSpindles, ALineThatAsksHasNoEffectBefore) {
  TestMachine machine = num_machine();
  EXPECT_THAT(with_values(machine, "L2=2\nL0=L0+1 L2=L2*L2 L1=E93524+E93525 E98024=E93524\nXL0 YL1 ZL2\nM2",
                          {1, 1, 1}),
              ElementsAre("read 8", "read 9", "read 8", "alarm 1156 2:35"));
  machine.external = {{98024, 300}};
  EXPECT_THAT(with_values(machine, "L2=2\nL0=L0+1 L2=L2*L2 L1=E93524+E93525\nXL0 YL1 ZL2\nM2", {1, 1}),
              ElementsAre("read 8", "read 9", "rapid X1 Y2 Z4", "end 2"));
}

TEST(NumSpindles, AMasterNeedsTheMarksOfBothAndTheAlarmNamesTheSpindle) {
  TestMachine machine = num_machine();
  EXPECT_THAT(with_values(machine, "EC90\nE94125=24\nE94125=-1\nM2", {1, 1}),
              ElementsAre("order 0 90", "read 0", "read 1", "order 94125 24", "order 94125 -1", "end 2"));
  EXPECT_THAT(with_values(machine, "E94124=27", {1, 0}), ElementsAre("read 3", "read 0", "alarm 1139 1:1"));
}

// E98025=-E98025 is only an order: the time stays.
TEST(NumSpindles, TheIntegralTimeIsAParameterAndItsSignAnOrder) {
  TestMachine machine = num_machine();
  machine.external = {{98025, 400}};
  EXPECT_THAT(
      with_values(machine, "XE98025\nE98025=500\nE98025=-E98025\nYE98025\nE98025=-E98025\nE98025=0\nM2", {}),
      ElementsAre("rapid X400", "table6 100025 500", "order 98025 500", "order 98025 -500",
                  "rapid X400 Y-500", "order 98025 500", "order 98025 0", "end 2"));
}

TEST(NumSpindles, ParametersAreWrittenAsByG10AndReadAgain) {
  TestMachine machine = num_machine();
  machine.external = {{90330, 9000}};
  EXPECT_THAT(with_values(machine, "E90330=20000\nXE90330\nE91024=0 X1\nM2", {}),
              ElementsAre("table6 100330 20000", "rapid X20000", "rapid X1", "end 2"));
}

// As printed but for the S50% of its fifth line, whose % is a misprint. Spindle 1 has passed its mark,
// spindle 2 does so in the first pass; both are synchronized at the second question.
TEST(NumSpindles, TheProgramOfTheManualRuns) {
  TestMachine machine = num_machine();
  for (const std::uint32_t number :
       {90330u, 90331u, 90370u, 90371u, 90380u, 90381u, 90321u, 98025u, 90360u, 90361u})
    machine.external[number] = 0;
  const auto commands = with_values(machine,
                                    "(SPEED CONTROLLED SPINDLE SYNCHRONISATION)\n(MASTER = B1 SLAVE = B2)\n"
                                    "WHILE E91124=1 DO $Homing on spindle 1\nM64M40M3S50\nENDW\n"
                                    "WHILE E91125=1 DO $Homing on broche 2\nM65M40M3S50\nENDW\n"
                                    "E94124=-1\nE94125=-1\nE91024=0\nE91025=0\nE90330=20000\nE90331=20000\n"
                                    "E90370=1500\nE90371=1500\nE90380=4000\nE90381=4000\nE90321=500\n"
                                    "E98025=500\nE90360=1\nE90361=1000\nM64 M40 M4 S100 EC0\n"
                                    "M65 M40 M4 S100\nE94125=24\nWHILE E93525=0 DO G4 F.5 $\nENDW\n"
                                    "$SYNCHRO OK\nM64 M40 M3 S2000\n"
                                    "WHILE E93525=0 DO G4 F.5 $Wait for synchronisation at 2000 rpm\nENDW\n"
                                    "E98025=-E98025\nG4 F5\nE98025=-E98025\nG4 F5\nM2\n",
                                    {1, 0, 1, 1, 1, 0, 1, 0, 1});
  EXPECT_THAT(
      commands,
      ElementsAre("read 0", "read 1", "message 10000", "M65", "S50", "M40", "M3", "read 1", "order 94124 -1",
                  "order 94125 -1", "table6 100330 20000", "table6 100331 20000", "table6 100370 1500",
                  "table6 100371 1500", "table6 100380 4000", "table6 100381 4000", "table6 100321 500",
                  "table6 100025 500", "order 98025 500", "table6 100360 1", "table6 100361 1000",
                  "order 0 0", "M64", "S100", "M40", "M4", "M65", "S100", "M40", "M4", "read 0", "read 1",
                  "order 94125 24", "read 9", "dwell 0.5", "read 9", "message 10000", "M64", "S2000", "M40",
                  "M3", "read 9", "message 10000", "dwell 0.5", "read 9", "order 98025 -500", "dwell 5",
                  "order 98025 500", "dwell 5", "end 2"));
}

// #4811 + 10 is the master of spindle 1: variables count from 1.
TEST(IsoSpindles, SystemVariablesReadTheStateAndOrderTheSynchronization) {
  TestMachine machine;
  EXPECT_THAT(with_values(machine,
                          "WHILE #4802 EQ 0\nM3\nENDW\n#4880=30\n#4822=1\n#4872=2\nG0 X#4812 Y#4842\n"
                          "IF #4832 GT 1\nX5\nELSEIF #4832 GT 0.25\nX6\nENDIF\n#4822=0\nM30",
                          {0, 1, 1, 1, 1, 500, 0.5, 0.5}),
              ElementsAre("read 1", "M3", "read 1", "order 0 30", "read 0", "read 1", "order 94125 24",
                          "order 98025 -1", "read 9", "read 33", "rapid X1 Y500", "read 25", "read 25",
                          "rapid X6 Y500", "order 94125 -1", "end 30"));
  EXPECT_EQ(run(machine, "#4821=1").alarm.number, AlarmNumber::variable_value) << "itself";
  EXPECT_EQ(run(machine, "#4872=3").alarm.number, AlarmNumber::variable_value);
  EXPECT_EQ(run(machine, "#4811=1").alarm.number, AlarmNumber::variable_read_only);
  const Interpretation result = run(machine, "#4822=1");
  EXPECT_EQ(result.alarm.number, AlarmNumber::spindle_without_mark);
  EXPECT_NE(std::string(result.alarm.text.data()).find("spindle 1"), std::string::npos);
}

}  // namespace
}  // namespace trunnion::language::test
