// SPDX-License-Identifier: Apache-2.0
// Programs of NUM 1020 to 1060 T controls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "language/num_codes.hpp"
#include "language/num_parameters.hpp"
#include "num_program.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

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

TEST(NumDialect, TheTextOfAMessageIsReadableWhileItsCommandIsTheNewest) {
  TestMachine machine = num_machine();
  // 0xe9 is an e with an acute accent in Windows-1252 and no UTF-8; the last text has 49 characters of two
  // bytes.
  std::string long_text;
  for (int i = 0; i < 49; ++i) long_text += "\xc3\xa9";
  const std::string text =
      "$ HELLO \xe9\t.  \nG77 H5\nX1 $" + long_text + "\nX2\n%5\nIF 1=1 THEN $5 \xc2\xb5m\nENDI\n";
  StringSource source(text);
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  EXPECT_EQ(interpreter.message_text(), "");
  std::vector<std::string> texts;
  Command command;
  while (interpreter.next(command) == Step::command)
    if (command.kind == CommandKind::message) texts.emplace_back(interpreter.message_text());
  EXPECT_THAT(texts, ElementsAre("HELLO \xc3\xa9?.", "5 \xc2\xb5m", long_text.substr(0, 96)));
  StringSource other("X1\nM2");
  interpreter.start(other, {}, {});
  EXPECT_EQ(interpreter.message_text(), "");
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

// As the homing programs of the manual are printed. An IF without ELSE, a loop, and what is open within an
// ELSE still need their ends.
TEST(NumDialect, TheEndOfAProgramClosesAnIfBehindItsElse) {
  EXPECT_THAT(num_stream("IF 1=1 THEN\nX1\nELSE\nX2\n"), ElementsAre("rapid X1", "end 0"));
  EXPECT_THAT(num_stream("IF 1=2 THEN\nX1\nELSE\nX2\n"), ElementsAre("rapid X2", "end 0"));
  for (const char* condition : {"1=1", "1=2"})
    EXPECT_THAT(
        num_stream(std::string("G77 H7\nY5\nM2\n%7\nIF ") + condition + " THEN\nX1\nELSE\nX2\n%8\nX3\n"),
        ElementsAre(condition == std::string("1=1") ? "rapid X1" : "rapid X2",
                    condition == std::string("1=1") ? "rapid X1 Y5" : "rapid X2 Y5", "end 2"))
        << condition;
  EXPECT_THAT(num_stream("IF 1=2 THEN\nELSE\nIF 1=2 THEN\nELSE\nX1\n"), ElementsAre("rapid X1", "end 0"));
  // A jump from one branch into the other.
  EXPECT_THAT(num_stream("IF 1=1 THEN\nG79 N5\nELSE\nX9\nN5 X1\n"), ElementsAre("rapid X1", "end 0"));
  EXPECT_THAT(num_stream("IF 1=2 THEN\nX1\n"), ElementsAre("alarm 1405 1:1"));
  EXPECT_THAT(num_stream("IF 1=2 THEN\nELSE\nIF 1=1 THEN\nX1\n"), ElementsAre("rapid X1", "alarm 1405 3:1"));
  EXPECT_THAT(num_stream("IF 1=1 THEN\nX1\nELSE\nIF 1=1 THEN\n"), ElementsAre("rapid X1", "alarm 1405 3:1"));
  EXPECT_THAT(num_stream("WHILE 1=2 DO\nIF 1=1 THEN\nELSE\n"), ElementsAre("alarm 1405 1:1"));
  EXPECT_THAT(num_stream("IF 1=2 THEN\nELSE\nWHILE 1=2 DO\nX1\n"), ElementsAre("alarm 1405 3:1"));
  TestMachine iso;
  EXPECT_EQ(run(iso, "IF 0\nELSE\nX2\n").alarm.number, AlarmNumber::begin_without_end);
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
      {num_function_missing, "G33 Z-13 K2 P1", 1, 13, ": P1, thread cutting cycle"},
      {num_function_missing, "G33 Z-13 K2 Q1", 1, 13, ": Q1, thread cutting cycle"},
      {num_function_missing, "G33 Z-13 K2 F2", 1, 13, ": F2, thread cutting cycle"},
      {num_function_missing, "G33 Z-13 K2 R2", 1, 13, ": R2, thread cutting cycle"},
      {num_function_missing, "G33 S9 Z-13 K2", 1, 5, ": S9, thread cutting cycle"},
      {num_function_missing, "G33 Z-13 K2 ES9", 1, 13, ": ES, thread cutting cycle"},
      {num_function_missing, "G33 Z-13 K2 EA30", 1, 13, ": EA, thread cutting cycle"},
      {num_function_missing, "EB30", 1, 1, ": EB, thread cutting cycle"},
      {num_removal_words, "M64 G39+ M3 M41 S200 W10", 1, 5, ": G39+, NUM error 2"},
      {num_removal_words, "G39+ M3 S200 K0 Z10", 1, 1, ": G39+, NUM error 2"},
      {num_removal_words, "G39+ M3 K1 Z10", 1, 1, ": G39+, NUM error 2"},
      {num_removal_words, "G39+ M3 S200 K1", 1, 1, ": G39+, NUM error 2"},
      {num_removal_words, "G39+ S200 K1 Z10", 1, 1, ": G39+, NUM error 2"},
      {num_removal_words, "G39+ M3 S200 K1 Z10 F100", 1, 1, ": G39+, NUM error 2"},
      {num_removal_words, "G39+ M3 S200 K1 Z10 EK2", 1, 1, ": G39+, NUM error 2"},
      {num_removal_words, "G39+ M3 S200 K1 Z10 EC90", 1, 1, ": G39+, NUM error 2"},
      {num_removal_words, "G90 G39+ M3 S200 K1 Z10", 1, 5, ": G39+, NUM error 2"},
      {num_removal_words, "G39+ M3 M8 S200 K1 Z10", 1, 9, ": M8, NUM error 2"},
      {num_removal_words, "G39+ M3 M46 S200 K1 Z10", 1, 9, ": M46, NUM error 2"},
      {num_removal_twice, "G39+ M3 M4 S200 K1 Z10", 1, 1, ": G39+, NUM error 1"},
      {num_removal_twice, "G39+ M3 M40 M41 S200 K1 Z10", 1, 1, ": G39+, NUM error 1"},
      {tap_removal_axis, "M64 G39+ M3 M41 S200 K1.2 Z1 W10", 1, 5, ": G39+"},
      {num_removal_words, "G39+ M3 S200 K1 A10", 1, 1, ": G39+, NUM error 2"},
      {tap_removal_axis, "G39+ M3 S200 K1 X1 Z10", 1, 1, ": G39+"},
      {tap_removal_spindle, "M3\nG39+ M4 S200 K1 Z10", 2, 1, ": G39+"},
      {tap_removal_lead, "G39+ M4 S0 K1 Z10", 1, 1, ": G39+"},
      {num_word, "EC90 G33 Z-13 K2 EZ-9", 1, 1, ": EC"},
      {num_word, "G38 K2 Z-1 EC90", 1, 12, ": EC"},
      {num_word, "EZ-L0", 1, 1, ": EZ"},
      {num_word, "G38 EX1 K2 Z-13", 1, 5, ": EX"},
      {num_word, "J-18 Z1", 1, 1, ": J-18"},
      {num_word, "G1 X1 K2 F1", 1, 7, ": K2"},
      {num_word, "G2 X2 R1 K2 F1", 1, 10, ": K2"},
      {num_word, "G33 Z-13 W1 K2", 1, 10, ": W1"},
      {num_word, "M3 S500 G38 K2 Z-1\nX2 F100", 2, 4, ": F100"},
      {num_word, "M3 S500 G38 K2 Z-1\nX2 M8", 2, 4, ": M8"},
      {num_word, "M3 S500 G38 K2 Z-1\nG91 X2", 2, 1, ": G91"},
      {num_word, "M3 S500 G38 K2 Z-1\nX2 G77 H5", 2, 4, ": G77"},
      {num_word, "M3 S500 G38 K2 Z-1\nX2 $text", 2, 1, ": X2"},
      {num_word, "M3 S500 G38 K2 Z-1\nX2 EC90", 2, 4, ": EC"},
      {num_word, "M3 S500 G38 K2 Z-1\nE94125=-1 X2", 2, 1, ": E94125"},
      {num_thread_data, "G33 Z-13 K2 EC90", 1, 13, ": EC, needs EZ or EX"},
      {num_thread_data, "G33 Z-13 K2 EZ-9", 1, 13, ": EZ, needs EC"},
      {num_thread_data, "G33 X-13 K2 EX-9", 1, 13, ": EX, needs EC"},
      {num_thread_data, "G33 Z-13 K2 EC9 EX1 EZ1", 1, 21, ": EZ, both EX and EZ"},
      {num_thread_data, "M3 S500\nG33 Z-13 X1 K2 EC9 EX1", 2, 20, ": EX, X does not go farthest"},
      {num_thread_data, "M3 S500\nG33 Z-1 X13 K2 EC9 EZ1", 2, 20, ": EZ, Z does not go farthest"},
      {num_homing_axis, "L0=9 G77 H9990.9", 1, 10, ": H9990.9"},
      {num_homing_axis, "L0=0.5 G77 H9990.9", 1, 12, ": H9990.9"},
      {num_homing_axis, "L0=-1 G77 H9990.9", 1, 11, ": H9990.9"},
      // X is 0, and so is an L0 that was not written.
      {num_homing_axis, "F2000 G77 H9990.9", 1, 11, ": H9990.9"},
      {num_homing_axis, "L1=2 G77 H9990.9", 1, 10, ": H9990.9"},
      {missing_word, "G159", 1, 1, ": G159, needs an axis"},
      {missing_word, "G38 Z-13", 1, 1, ": G38, needs K"},
      {missing_word, "G33 Z-13", 1, 1, ": G33, needs K"},
      {missing_word, "G33 K2", 1, 1, ": G33, needs an axis"},
      {missing_word, "G38+ J-18 EC90 K2", 1, 1, ": G38+, needs an axis"},
      {missing_word, "G38+ K2 J-18 EC90 Z-13", 1, 1, ": G38+, needs J and EC behind it"},
      {missing_word, "G38+ J-18 K2 EC90 Z-13", 1, 1, ": G38+, needs J and EC behind it"},
      {thread_lead_missing, "G38 K0 Z-1", 1, 5, ": K0"},
      {thread_spindle_stopped, "G38 K2 Z-1", 1, 8, ": Z-1"},
      {group_twice, "G38 G33 K2 Z1", 1, 5, ": G33"},
      {group_twice, "G1 G38 K2 Z1", 1, 4, ": G38"},
      {letter_twice, "G33 Z-13 K2 EC1 EC2", 1, 17, ": EC"},
      {letter_twice, "G38+ J-18 EC90 K2 Z-13 EC9", 1, 24, ": EC"},
      {num_word, "G2 X1 I1", 1, 7, ": I1"},
      {num_word, "G33 Z-13 K2 EK2", 1, 13, ": EK"},
      {num_word, "G1 X1 F1 EK2", 1, 10, ": EK"},
      {num_word, "EH1", 1, 1, ": EH"},
      {num_word, "ER1", 1, 1, ": ER"},
      {letter_twice, "G84 Z-5 K1 EK2 EK3", 1, 16, ": EK"},
      {missing_word, "M3 S60 G84 Z-5", 1, 8, ": G84, needs K"},
      {num_tap_axis, "M3 S60\nG84 K1", 2, 1, ": G84"},
      {num_tap_axis, "M3 S60\nG84 X1 Z-5 K1", 2, 1, ": G84"},
      {num_tap_axis, "M3 S60\nG84 Y-5 K1", 2, 1, ": G84"},
      {num_tap_incremental, "M3 S60 G91 G84 Z-5 K1", 1, 12, ": G84"},
      {num_tap_lead, "M3 S60 G84 Z-5 K0", 1, 16, ": K0"},
      {num_tap_lead, "M3 S60 G84 Z-5 K1 EK-2", 1, 19, ": EK"},
      {num_tap_spindle, "S60 G84 Z-5 K1 M5", 1, 5, ": G84"},
      {num_tap_spindle, "M3 G84 Z-5 K1", 1, 4, ": G84"},
      {num_tap_level, "M3 S60 G84 Z0 K1", 1, 8, ": G84"},
      // The rapid to ER would go 2 mm into the hole.
      {num_tap_level, "M3 S60 G84 Z-5 K1 EH1 ER-1", 1, 19, ": EH"},
      {num_tap_modal, "M3 S60 G84 Z-5 K1\nF100 X5", 2, 6, ": X5"},
      {num_word, "M3 S60 G84 Z-5 K1\nZ-6 K2", 2, 5, ": K2"},
      {group_twice, "M3 S60 G38 G84 Z-5 K1", 1, 12, ": G84"},
      {num_word, "D1", 1, 1, ": D1"},
      {num_word, "O1234", 1, 1, ": O1234"},
      {num_word, "G1 N5", 1, 4, ": N5"},
      {num_word, "H5", 1, 1, ": H5"},
      {num_word, "G77 H5 S2", 1, 8, ": S2"},
      {num_word, "G4 F1 X2", 1, 7, ": X2"},
      {num_parameter_unknown, "L0=E12345", 1, 4, ": E12345"},
      {num_parameter_unknown, "L0=E[FOO]", 1, 4, ": E"},
      {num_parameter_unknown, "L0=E[MUCHTOOLONG]", 1, 4, ": E"},
      {num_parameter_unknown, "E35332 = 0", 1, 1, ": E35332, NUM error 92"},
      {num_parameter_unknown, "E94299=24", 1, 1, ": E94299, NUM error 92"},
      {num_parameter_unknown, "L0=E91109", 1, 4, ": E91109"},
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
      {variable_read_only, "E91108=0", 1, 1, ": E91108"},
      {variable_value, "E80000=1.5", 1, 1, ": E80000, a whole number"},
      {variable_unknown, "L20=1", 1, 1, ": L20, L0 to L19 and L100 to L199"},
      {letter_twice, "X1 X2", 1, 4, ": X2"},
      {missing_word, "G4", 1, 1, ": G4, needs F"},
      {missing_word, "G77", 1, 1, ": G77, needs H"},
      {missing_word, "G79 L0=1", 1, 1, ": G79, needs N"},
      {value_range, "G77 H0.5", 1, 5, ": H0.5"},
      {not_an_integer, "G77 H1.25", 1, 5, ": H1.25"},
      {subprogram_missing, "G77 H9990.8", 1, 5, ": H9990.8"},
      {label_missing, "G79 N9", 1, 1, ": G79, N9"},
      {operand_missing, "L0", 1, 3, ", needs ="},
      {operand_missing, "IF L0 THEN", 1, 7, ": THEN, needs = <> < > <= or >="},
      {operand_missing, "IF 1=1 G0", 1, 8, ": G0, needs THEN"},
      {operand_missing, "WHILE 1=1", 1, 10, ", needs DO"},
      {statement_not_first, "G0 IF 1=1 THEN", 1, 4, ": IF"},
      {statement_not_first, "G0 G79 N1", 1, 4, ": G79"},
      {text_behind_statement, "IF 1=1 THEN\nENDI X1", 2, 6, ": X1"},
      {text_behind_statement, "IF 1=1 THEN\nELSE $text", 2, 6, ": $"},
      // A jump leads behind these lines.
      {text_behind_statement, "IF 1=2 THEN\nX1\nELSEIF 2=2 THEN\nX2\nENDI", 3, 5, ": IF"},
      {text_behind_statement, "IF 1=2 THEN\nX1\nELSE X2\nENDI", 3, 6, ": X2"},
      {text_behind_statement, "IF 1=2 THEN\nELSE $text\nENDI", 2, 6, ": $"},
      {text_behind_statement, "IF 1=2 THEN\nN5 ENDI (end) X1", 2, 15, ": X1"},
      {text_behind_statement, "IF 1=2 THEN\nENDIF", 2, 5, ": F"},
      {text_behind_statement, "WHILE 1=2 DO\nENDW M5", 2, 6, ": M5"},
      {open_comment, "WHILE 1=2 DO\nENDW (open", 2, 11, ""},
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
    if (number >= 1150 && number <= 1171) {
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
  EXPECT_EQ(alarm(iso, "G4 F1"), AlarmNumber::foreign_word);
  EXPECT_EQ(alarm(num, "G4 F1"), AlarmNumber::none);
  EXPECT_EQ(alarm(iso, "G4 P100"), AlarmNumber::none);
  EXPECT_EQ(alarm(num, "G4 P100"), AlarmNumber::num_word);
  EXPECT_EQ(alarm(iso, "G77 H5"), AlarmNumber::foreign_word);
  EXPECT_EQ(alarm(num, "G77 H5"), AlarmNumber::subprogram_missing);
  EXPECT_EQ(alarm(iso, "G95 S100 G84 Z-4 R1 F1 K2"), AlarmNumber::none);
  EXPECT_EQ(alarm(num, "G95 S100 G84 Z-4 R1 F1 K2"), AlarmNumber::num_tap_spindle);
  EXPECT_EQ(alarm(num, "G95 S100 M3 G84 Z-4 R1 F1 K2"), AlarmNumber::unused_word);
  // Two taps of lead 1, in and out; one tap of lead 2.
  EXPECT_EQ(run(iso, "G95 S100 G99 G84 Z-4 R1 F1 K2\nM2").commands.size(), 7u);
  EXPECT_EQ(run(num, "G95 S100 M3 G84 Z-4 F1 K2\nM2").commands.size(), 7u);
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

TEST(NumDialect, ProgramsOfTheManualRun) {
  EXPECT_THAT(num_stream("G39+ M3 M41 S200 K1.2 W10\n"), ElementsAre("S200", "tap W10 lead1.2", "end 2"));
  EXPECT_THAT(num_stream("E80000=3 E80001=42\nL0=200 L1=1.25\nG39+ ME80000 ME80001 SL0 KL1 Z-10\n"),
              ElementsAre("S200", "tap Z-10 lead1.25", "end 2"));
  // Thread cutting with tapered retraction: lead 2, taught at Z-13 and 90 deg, from Z5 9 revolutions.
  EXPECT_THAT(num_stream("M3 S500\nG0X0Z5\nG38+ J-18 EC90 K2 Z-20\nX4 Z-24\nG0 X20\nM2"),
              ElementsAre("S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "thread X4 Z-24 lead2",
                          "rapid X20 Z-24", "end 2"));
}

// To the C axis and back: each of the lines is refused by name, and none is passed over.
TEST(NumDialect, TheSwitchingBetweenSpindleAndCAxisIsNotThere) {
  for (const char* line : {"E35324 = 0", "E94224 = 24 G4F1", "E91008 = 0 G4F1", "E35324 = 11",
                           "E94224 = 8 G4F1", "E91008 = 1 G4F1"})
    EXPECT_THAT(num_stream(line), ElementsAre("alarm 1156 1:1")) << line;
}

}  // namespace
}  // namespace trunnion::language::test
