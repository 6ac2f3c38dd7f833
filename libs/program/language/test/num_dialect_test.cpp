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

TEST(NumDialect, TheTextOfAMessageIsReadableWhileItsCommandIsTheNewest) {
  TestMachine machine = num_machine();
  // 0xe9 is an e with an acute accent in Latin-1 and no UTF-8; the last text has 49 characters of two bytes.
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
  EXPECT_THAT(texts, ElementsAre("HELLO ??.", "5 \xc2\xb5m", long_text.substr(0, 96)));
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

// The example of the document, from EH 2: 202 mm at 1.25 mm per revolution, out at 2.5 times 500 1/min.
TEST(NumDialect, ATapHasItsLeadAndTheSpeedOfItsWayOut) {
  EXPECT_THAT(num_stream("G71 S500 M3\nG0 Z10\nG84 Z-200 K1.25 EK2.5 EH2 M5\nM2"),
              ElementsAre("S500", "M3", "rapid Z10", "rapid Z2", "M5", "tap Z-200 lead1.25",
                          "tap Z2 lead1.25 S1250", "M5", "end 2"));
  // 60 1/min times 2.
  EXPECT_THAT(num_stream("S60 M3 Z4\nG84 Z1 K1 EK2\nM2"),
              ElementsAre("S60", "M3", "rapid Z4", "M5", "tap Z1 lead1", "tap Z4 lead1 S120", "M3", "end 2"));
  TestMachine machine = num_machine();
  machine.highest_speed = 100;
  EXPECT_EQ(std::string(run(machine, "S60 M3 G84 Z-1 K1 EK2").alarm.text.data()),
            std::string(alarm_text(AlarmNumber::spindle_speed_above)) +
                ": EK, S times EK 120, at most 100 1/min (10a948)");
}

// 500 1/min times 2.5.
TEST(NumDialect, BothStrokesOfATapTellTheFasterOne) {
  const auto speeds = [](const std::string& text) {
    TestMachine machine = num_machine();
    const Interpretation result = run(machine, text);
    std::vector<double> fastest;
    for (const Command& command : result.commands)
      if (command.kind == CommandKind::tap) fastest.push_back(fastest_stroke(command));
    return fastest;
  };
  EXPECT_THAT(speeds("S500 M3\nG84 Z-200 K1.25 EK2.5 EH2\nM2"), ElementsAre(1250, 1250));
  EXPECT_THAT(speeds("S500 M3\nG84 Z-200 K1.25 EK.5 EH2\nM2"), ElementsAre(500, 250));
  EXPECT_THAT(speeds("S500 M3\nG84 Z-200 K1.25 EH2\nM2"), ElementsAre(500, 500));
}

TEST(NumDialect, BehindATapTheSpindleTurnsAsBeforeOrStandsWithM5) {
  TestMachine machine = num_machine();
  EXPECT_EQ(run(machine, "S60 M4 G84 Z-1 K1\nM2").modal.spindle_direction, SpindleDirection::ccw);
  EXPECT_EQ(run(machine, "S60 M4 G84 Z-1 K1 M5\nM2").modal.spindle_direction, SpindleDirection::stopped);
  // M4 cuts a left-hand thread. F is the feed behind it, G80 ends the cycle.
  EXPECT_THAT(num_stream("S60 M4 Z1\nG84 Z-1 K1 F200\nL0=[.RG80]\nG80\nG1 Z3 XL0\nM2"),
              ElementsAre("S60", "M4", "rapid Z1", "M5", "tap Z-1 lead-1", "tap Z1 lead-1", "M4",
                          "line X84 Z3 F200", "end 2"));
}

TEST(NumDialect, LeadAndLevelsOfATapAreInTheUnitOfTheProgram) {
  // 0.05 inch = 1.27 mm, 0.1 = 2.54 mm, 0.5 = 12.7 mm; EK is a ratio.
  EXPECT_THAT(num_stream("G70 S500 M3\nG84 Z-1 K.05 EK2 EH.1 ER.5\nM2"),
              ElementsAre("S500", "M3", "rapid Z12.7", "rapid Z2.54", "M5", "tap Z-25.4 lead1.27",
                          "tap Z2.54 lead1.27 S1000", "M3", "rapid Z12.7", "end 2"));
  EXPECT_THAT(
      num_stream("L1=1.25 S500 M3\nG84 Z-1 KL1 EKL1 EH1\nM2"),
      ElementsAre("S500", "M3", "rapid Z1", "M5", "tap Z-1 lead1.25", "tap Z1 lead1.25 S625", "M3", "end 2"));
  // X is a diameter, and so are EH and ER of a tap along it; K is not.
  TestMachine machine = num_machine();
  machine.diameter = true;
  EXPECT_THAT(stream(run(machine, "S100 M3 Z-7\nG84 X20 K2 EH40 ER44\nM2")),
              ElementsAre("S100", "M3", "rapid Z-7", "rapid X22 Z-7", "rapid X20 Z-7", "M5",
                          "tap X10 Z-7 lead2", "tap X20 Z-7 lead2", "M3", "rapid X22 Z-7", "end 2"));
}

// The thread is modal, and still the K of G84 is that of the tap. 500 1/min times 2.
TEST(NumDialect, ATapBetweenThreadsHasItsOwnLead) {
  EXPECT_THAT(num_stream("M3 S500\nG38 K2 Z-1\nG84 Z-5 K1 EK2\nG38 K3 Z-9\nZ-10\nM2"),
              ElementsAre("S500", "M3", "thread Z-1 lead2", "M5", "tap Z-5 lead1", "tap Z-1 lead1 S1000",
                          "M3", "thread Z-9 lead3", "thread Z-10 lead3", "end 2"));
}

// Ten millimetres at a lead of 1.2 mm; clockwise with M3 whatever the direction. The PLC gets no M3, M4 and
// range.
TEST(NumDialect, ATapIsRemovedInTheSenseThatIsWritten) {
  EXPECT_THAT(num_stream("M64 G39+ M3 M41 S200 K1.2 Z10\nX1\nM2"),
              ElementsAre("M64", "S200", "tap Z10 lead1.2", "end 2"));
  EXPECT_THAT(num_stream("G39+M4S200K1.2Z10"), ElementsAre("S200", "tap Z10 lead-1.2", "end 2"));
  // The distance is incremental, also with G90, and in the unit of the program.
  EXPECT_THAT(num_stream("G70 G90 X1 Z1\nG39+ M4 S200 K.1 X.5\nM2"),
              ElementsAre("rapid X25.4 Z25.4", "S200", "tap X38.1 Z25.4 lead-2.54", "end 2"));
}

TEST(NumDialect, TheRemovalOfATapEndsTheProgramsThatHaveCalledIt) {
  EXPECT_THAT(num_stream("G77 H5\nX50\nM2\n%5\nG77 H6\nX40\n%6\nG39+ M4 S200 K1 Z10\n"),
              ElementsAre("S200", "tap Z10 lead-1", "end 2"));
  // An M2 of the program itself still returns.
  EXPECT_THAT(num_stream("G77 H5\nX50\nM2\n%5\nM2\n"), ElementsAre("rapid X50", "end 2"));
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

TEST(NumThreads, AThreadAndTheBlocksThatContinueIt) {
  EXPECT_THAT(num_stream("G0 Z5\nM3 S500\nG38 K2 Z-13 (first)\nX4 Z-15 K3\nN9 X5\nG0 X20\nM2"),
              ElementsAre("rapid Z5", "S500", "M3", "thread Z-13 lead2", "thread X4 Z-15 lead3",
                          "thread X5 Z-15 lead3", "rapid X20 Z-15", "end 2"));
  // F is a feed, also between threads; a block without an end is not one of the thread.
  EXPECT_THAT(num_stream("M3 S500\nG38 F100 K2 Z-1\nM8 F300\nG1 Z-2\nM2"),
              ElementsAre("S500", "M3", "thread Z-1 lead2", "M8", "line Z-2 F300", "end 2"));
  EXPECT_THAT(num_stream("M3 S500 G38 K2 Z-1\nL0=[.RG0]\nG0 XL0\nM2"),
              ElementsAre("S500", "M3", "thread Z-1 lead2", "rapid X38 Z-1", "end 2"));
}

// Lead 2, taught at Z-13 with the spindle at 90 deg. From Z5 it is 18 mm, 9 revolutions; from Z5.5 9.25.
TEST(NumThreads, AResumedThreadBeginsAtTheAngleThatPutsTheToolIntoThePitch) {
  EXPECT_THAT(num_stream("M3 S500\nG0 Z5\nG38+ J-18 EC90 K2 Z-20\nM2"),
              ElementsAre("S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "end 2"));
  EXPECT_THAT(num_stream("M3 S500\nG0 Z5.5\nG38+J-18.5EC90K2Z-20\nM2"),
              ElementsAre("S500", "M3", "rapid Z5.5", "thread Z-20 lead2", "end 2"));
  // The parameters may be variables; a whole turn more of EC is the same angle.
  EXPECT_THAT(num_stream("M3 S500 L1=-18 L2=450\nG0 Z5\nG38+ JL1 ECL2 K2 Z-20\nM2"),
              ElementsAre("S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "end 2"));
}

TEST(NumThreads, ItsStartAngleCountsInTheDirectionOfTheThreadAndOfTheSpindle) {
  const auto thread = [](const std::string& program) {
    for (const auto& command : num_stream(program + "\nM2"))
      if (command.rfind("thread", 0) == 0) return command;
    return std::string("none");
  };
  // From Z-20 upwards to Z-13: 3.5 revolutions, 90 - 1260 = -1170 = 270 - 4 * 360.
  EXPECT_EQ(thread("M3 S500\nG0 Z-20\nG38+ J7 EC90 K2 Z5"), "thread Z5 lead2 from270");
  // The taught place is 2.5 mm behind the start: 1.25 revolutions before it, 90 + 450 = 540.
  EXPECT_EQ(thread("M3 S500\nG0 Z-15.5\nG38+ J2.5 EC90 K2 Z-20"), "thread Z-20 lead2 from180");
  // M4: the angle falls. 225 deg in its direction is 135; 9.125 revolutions less, 135 - 3285 = 90 - 9 * 360.
  EXPECT_EQ(thread("M4 S500\nG0 Z5.25\nG38+ J-18.25 EC90 K2 Z-20"), "thread Z-20 lead2 from225");
  // A taper: X goes farther and has the lead; 2.5 revolutions.
  EXPECT_EQ(thread("M3 S500\nG38+ J-5 EC0 K2 X-10 Z-8"), "thread X-10 Z-8 lead2 from180");
  // At 45 degrees J belongs to the axis of its direction, so that the taught place is ahead: 1.25
  // revolutions.
  EXPECT_EQ(thread("M3 S500\nG38+ J-2.5 EC180 K2 X10 Z-10"), "thread X10 Z-10 lead2 from90");
  EXPECT_EQ(thread("M3 S500\nG38+ J2.5 EC180 K2 X10 Z-10"), "thread X10 Z-10 lead2 from90");
  // 1.0125 inches are 10.125 leads of 0.1 inch: 90 - 3645 = 45 - 10 * 360.
  EXPECT_EQ(thread("G70 M3 S500\nG38+ J-1.0125 EC90 K.1 Z-2"), "thread Z-50.8 lead2.54 from45");
}

TEST(NumThreads, JAndEXOfADiameterAreDiameters) {
  TestMachine machine = num_machine();
  machine.diameter = true;
  // J: 5 mm, 2.5 revolutions. EX: from 30 to 15 in diameter are 7.5 mm, 3.75 revolutions.
  EXPECT_THAT(
      stream(run(machine, "M3 S500\nG38+ J-10 EC0 K2 X-40\nG0 X30\nG33 X10 K2 EC0 EX15\nM2")),
      ElementsAre("S500", "M3", "thread X-20 lead2 from180", "rapid X15", "thread X5 lead2 from90", "end 2"));
}

TEST(NumThreads, G33IsOnePassAndResumesByTheTaughtPosition) {
  TestMachine machine = num_machine();
  const Interpretation plain = run(machine, "M3 S500\nG33 Z-13 K2\nX20\nM2");
  EXPECT_THAT(stream(plain), ElementsAre("S500", "M3", "thread Z-13 lead2", "rapid X20 Z-13", "end 2"));
  EXPECT_EQ(plain.commands[2].number, 1u);
  EXPECT_EQ(plain.commands[2].modal.path_control, PathControl::exact_stop);
  EXPECT_EQ(plain.modal.path_control, PathControl::continuous);
  EXPECT_EQ(plain.modal.motion, 0);
  EXPECT_THAT(num_stream("M3 S500\nG0 Z5\nG33 Z-20 K2 EC90 EZ-13\nM2"),
              ElementsAre("S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "end 2"));
  // The taught position is no incremental word.
  EXPECT_THAT(num_stream("M3 S500\nG0 Z5.5\nG91 G33 Z-25.5 K2 EC90 EZ-13\nM2"),
              ElementsAre("S500", "M3", "rapid Z5.5", "thread Z-20 lead2", "end 2"));
  // Radial: 15 mm, 7.5 revolutions, 90 - 2700 = 270 - 8 * 360.
  EXPECT_THAT(num_stream("M3 S500\nG0 X30\nG33 X10 K2 EC90 EX15\nM2"),
              ElementsAre("S500", "M3", "rapid X30", "thread X10 lead2 from270", "end 2"));
  // At 45 degrees either: 3 mm, 1.5 revolutions.
  for (const char* taught : {"EX3", "EZ-3"})
    EXPECT_THAT(num_stream(std::string("M3 S500\nG33 X10 Z-10 K2 EC0 ") + taught + "\nM2"),
                ElementsAre("S500", "M3", "thread X10 Z-10 lead2 from180", "end 2"));
}

// The program of docs/threads.md: 90 - 360 * 18.5 / 2 = -3240 = 0, and from Z5 -3150 = 90 - 9 * 360.
TEST(NumThreads, TheIsoDialectTakesAThreadUpByItsStartAngle) {
  for (const bool farther : {true, false}) {
    TestMachine iso;
    const std::string start = farther ? "5.5" : "5";
    EXPECT_THAT(stream(run(iso, "M3 S500\n#1=-13 #2=90 #3=" + start +
                                    " #4=2     (taught Z, taught angle, start, lead)\n"
                                    "#5=#2-360*[#3-#1]/#4         (towards -Z, M3)\n"
                                    "#5=#5-360*FIX[#5/360]\nIF [#5 LT 0] THEN #5=#5+360\nG0 Z#3\n"
                                    "G33 Z-20 F#4 Q#5\nM2")),
                ElementsAre("S500", "M3", "rapid Z" + start,
                            farther ? "thread Z-20 lead2" : "thread Z-20 lead2 from90", "end 2"));
  }
}

TEST(NumThreads, OnlyAResumedThreadBeginsAnotherOne) {
  TestMachine machine = num_machine();
  const Interpretation result =
      run(machine, "M3 S500\nG38 K2 Z-1\nG38 K2 Z-2\nG38+ J-1 EC0 K2 Z-3\nZ-4\nG33 Z-5 K2\nZ-6\nM2");
  std::vector<std::uint32_t> begins;
  for (const Command& command : result.commands)
    if (command.kind == CommandKind::thread) begins.push_back(command.number);
  EXPECT_THAT(begins, ElementsAre(0u, 0u, 1u, 0u, 1u, 0u));
}

// X 1, Z 4, C 32.
TEST(NumHoming, G159NamesAxesWithOrWithoutANumber) {
  EXPECT_THAT(num_stream("F2000 G159 C\nM2"), ElementsAre("home32 F2000", "end 2"));
  EXPECT_THAT(num_stream("G159 C X Z (all)\nM2"), ElementsAre("home37", "end 2"));
  EXPECT_THAT(num_stream("G159XZ$ home\nM2"), ElementsAre("message 10000", "home5", "end 2"));
  EXPECT_THAT(num_stream("G159 X0 Z\nM2"), ElementsAre("home5", "end 2"));
  // F is the speed of the search only.
  EXPECT_THAT(num_stream("G94 F100\nF2000 G159 X\nG1 X1\nM2"),
              ElementsAre("home1 F2000", "line X1 F100", "end 2"));
}

TEST(NumHoming, TheControlCarriesOut9990Point9) {
  // Z U A in the numbers of L0; their bits are 2, 6 and 3.
  EXPECT_THAT(num_stream("L0=2 F2000 G77 H9990.9 (axe Z)\nL0=3 G77 H9990.9\nL0=6 F10 G77 H9990.9\nM2"),
              ElementsAre("home4 F2000", "home64 F2000", "home8 F10", "end 2"));
  // Behind the words of its block; also from another program, and in a loop.
  EXPECT_THAT(num_stream("L0=1 X5 G77 H9990.9\nG77 H7\nM2\n%7\nL0=0\nWHILE L0<2 DO G77 H9990.9\n"
                         "L0=L0+1\nENDW\n"),
              ElementsAre("rapid X5", "home2 X5", "home1", "home2", "end 2"));
  // 10 inch/min; F per revolution is no speed of the search.
  EXPECT_THAT(num_stream("G70 L0=2 F10 G77 H9990.9\nG95 F.1 G77 H9990.9\nM2"),
              ElementsAre("home4 F10", "home4", "end 2"));
  // An axis that the channel does not have is left out.
  TestMachine machine = num_machine();
  machine.axis_mask = 0b000000101;
  EXPECT_THAT(stream(run(machine, "L0=0 G77 H9990.9\nL0=1 G77 H9990.9\nL0=2 G77 H9990.9\nM2")),
              ElementsAre("home1", "home4", "end 2"));
  TestMachine iso;
  EXPECT_EQ(run(iso, "M98 P9990 L1").alarm.number, AlarmNumber::subprogram_missing);
}

// 1 as E91124 says it of spindles: not homed. X, Z and W had their references when the program began; C is
// bit 5, W bit 8.
TEST(NumHoming, AProgramCanAskWhichAxesAreNotHomed) {
  TestMachine machine = num_machine();
  StringSource source(
      "L1=E91100 L2=E91101 L3=E91105 L8=E91108\nXL1 YL2 ZL3 CL8\nWHILE E91108=1 DO L0=8 G77 H9990.9\nENDW\n"
      "Y4\nM2");
  Interpreter interpreter(machine);
  interpreter.set_homed(0b100000101);
  interpreter.start(source, {}, {});
  Interpretation result;
  Command command;
  do {
    result.last = interpreter.next(command);
    if (result.last == Step::command) result.commands.push_back(command);
    if (result.last == Step::position) interpreter.set_position(command.target);
  } while (result.last == Step::command || result.last == Step::position);
  // The search ends at the reference position of C, 0.
  EXPECT_THAT(stream(result), ElementsAre("rapid Y1 C1", "home32 Y1", "rapid Y4", "end 2"));
  interpreter.set_homed(std::nullopt);
  StringSource again("L1=E91100\nM2");
  interpreter.start(again, {}, {});
  EXPECT_EQ(interpreter.next(command), Step::alarm);
  EXPECT_EQ(interpreter.alarm().number, AlarmNumber::homed_unknown);
  machine.axis_mask = 0b000000101;
  EXPECT_EQ(run(machine, "L1=E91101").alarm.number, AlarmNumber::num_parameter_unavailable);
}

// The examples are as they are printed, comments translated. Z and X at their own feeds, Y at that of X, C.
// The condition does not hold, because G159 is carried out without these programs.
TEST(NumHoming, ThePrintedProgramForOneGroupRuns) {
  EXPECT_THAT(
      num_stream("$9990\n\nIF [.RG80] = 159 THEN (called by G159)\n   G77 H9990.9\n\nELSE (called in homing "
                 "mode: put the number of the axis into L0)\n        (Perhaps program the feed Fxxx)\n   "
                 "L0=2 F2000 G77 H9990.9 (axis Z)\n   L0=0 F3000 G77 H9990.9 (axis X)\n   L0=1 G77 H9990.9 "
                 "(axis Y)\n   L0=8 F10000 G77 H9990.9 (axis C)\nM2\n"),
      ElementsAre("message 10000", "home4 F2000", "home1 F3000", "home2 F3000", "home32 F10000", "end 2"));
}

// Neither has ENDI; the first one ends with M2, the second one with its text.
const std::string group_1 =
    "%9990.1 (Homing on group 1)\nIF [.RG80] = 159 THEN (call by G159)\n   G77 H9990.9\nELSE (call in homing "
    "mode: load axis no. in L0)\n     (programme the feed rate Fxxx if required)\n   L0=2 F2000 G77 "
    "H9990.9(Z "
    "axis)\n   G78 Q1 P1.2 (Wait for homing on Z on another group)\n   L0=0 F3000 G77 H9990.9(X axis)\n   "
    "L0=1 "
    "G77 H9990.9(Y axis)\n   L0=8 F10000 G77 H9990.9(C axis)\n  M2\n";
const std::string group_2 =
    "%9990.2 (Homing on group 2)\nIF [.RG80] = 159 THEN (call by G159)\n   G77 H9990.9\nELSE (call in homing "
    "mode: load axis no. in L0)\n    (programme the feed rate Fxxx if required)\n   L0=2 F2000 G77 H9990.9 "
    "(Z "
    "axis)\n   G78 Q1 P1.1 (Wait for homing on Z on another group)\n   L0=0 F3000 G77 H9990.9(X axis)\n   "
    "L0=1 "
    "G77 H9990.9(Y axis)\n";

std::string without_wait_mark(std::string program) {
  const auto begin = program.find("   G78");
  return program.erase(begin, program.find('\n', begin) + 1 - begin);
}

TEST(NumHoming, ThePrintedProgramsForTwoGroupsRunButForTheirWaitMarks) {
  EXPECT_THAT(num_stream(group_1 + group_2), ElementsAre("home4 F2000", "alarm 1152 7:4"));
  EXPECT_THAT(num_stream(group_2), ElementsAre("home4 F2000", "alarm 1152 7:4"));
  EXPECT_THAT(num_stream(without_wait_mark(group_1) + group_2),
              ElementsAre("home4 F2000", "home1 F3000", "home2 F3000", "home32 F10000", "end 2"));
  EXPECT_THAT(num_stream(without_wait_mark(group_2)),
              ElementsAre("home4 F2000", "home1 F3000", "home2 F3000", "end 0"));
  // As manual data input calls it, and with another program behind it.
  EXPECT_THAT(num_stream("G77 H9990.2\nM8\nM2\n" + without_wait_mark(group_2) + group_1),
              ElementsAre("home4 F2000", "home1 F3000", "home2 F3000", "M8", "end 2"));
}

// On a NUM control G159 calls the programs, and the condition holds. Here one that holds stands in its place:
// the axis is in L0, and nothing of the other branch is carried out, although no ENDI ends it.
TEST(NumHoming, TheBranchOfG159HomesTheAxisOfL0Alone) {
  for (auto program : {without_wait_mark(group_1), without_wait_mark(group_2)}) {
    program.replace(program.find("159 THEN"), 3, "80");
    EXPECT_THAT(num_stream("L0=8 F500\nG77 H" + program.substr(1, 6) + "\nM2\n" + program),
                ElementsAre("home32 F500", "end 2"));
  }
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

// Lead 2, taught at Z-13 with the spindle at 90 deg: from Z5 it is 18 mm, 9 revolutions.
TEST(NumSpindles, TheAngleOfASynchronizationIsNotThatOfAThread) {
  TestMachine machine = num_machine();
  EXPECT_THAT(
      with_values(machine, "M3 S500 EC45\nG0 Z5\nG33 Z-20 K2 EC90 EZ-13\nEC30\nM2", {}),
      ElementsAre("order 0 45", "S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "order 0 30", "end 2"));
  // Between threads it is in a block of its own or with another motion; a tap may have it.
  EXPECT_THAT(with_values(machine, "M3 S60\nG38 K2 Z-1\nEC90\nG0 X2 EC60\nG84 Z-5 K1 EC0 M5\nM2", {}),
              ElementsAre("S60", "M3", "thread Z-1 lead2", "order 0 90", "order 0 60", "rapid X2 Z-1",
                          "order 0 0", "M5", "tap X2 Z-5 lead1", "tap X2 Z-1 lead1", "M5", "end 2"));
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
