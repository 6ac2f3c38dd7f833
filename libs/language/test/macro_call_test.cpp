// Calls with arguments, modal calls, cycles, and whose variables are whose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

std::vector<Golden> programs() {
  return {
      {"G65 gives letters as Fanuc's list I numbers them",
       "G65 P10 A1 B2 C3 I4 J5 K6 D7 E8 F9 H11 M13 Q17 R18 S19 T20 U21 V22 W23 X24 Y25 Z26\nM30\n"
       "O10\nG0 X[#1+#2+#3+#4+#5+#6+#7+#8+#9+#11+#13] Y[#17+#18+#19+#20+#21+#22+#23+#24+#25+#26]\nM99\n",
       // 1+2+..+9 = 45, +11+13 = 69; 17+18+..+26 = 215
       {"rapid X69 Y215", "end 30"}},
      {"sets of I J K become #4 to #33 by list II",
       "G65 P10 A1 B2 C3 I4 J5 K6 I7 J8 K9 I10\nM30\nO10\nG0 X#4 Y#8 Z#10 A#1 B#2 C#3\nM99\n",
       {"rapid X4 Y8 Z10 A1 B2 C3", "end 30"}},
      {"a letter that does not go on begins the next set",
       "G65 P10 J5 I7 K9 K12\nM30\nO10\nG0 X#5 Y#7 Z#9 A#12 B#4\nM99\n",
       {"rapid X5 Y7 Z9 A12", "end 30"}},
      {"of D and the second I, which are both #7, the later counts",
       "G65 P10 I4 I7 D70\nG65 P10 D70 I4 I7\nM30\nO10\nG0 X#7\nM99\n",
       {"rapid X70", "rapid X7", "end 30"}},
      {"arguments may be computed, and a vacant one is not given",
       "#1=5\nG65 P10 A[#1*2] B#2\nM30\nO10\nG0 X#1\nIF #2 EQ #0\nY1\nENDIF\nM99\n",
       {"rapid X10", "rapid X10 Y1", "end 30"}},
      {"a macro has variables of its own, a subprogram those of its caller",
       "#1=1 #100=1\nG65 P10\nG0 X#1 Y#100\nM98 P10\nX#1\nM30\nO10\n#1=7 #100=2\nM99\n",
       {"rapid X1 Y2", "rapid X7 Y2", "end 30"}},
      {"L repeats a macro, each time with its arguments",
       "G91\nG65 P10 L3 A1\nM30\nO10\n#1=#1+1\nG0 X#1\nM99\n",
       {"rapid X2", "rapid X4", "rapid X6", "end 30"}},
      {"macros nest",
       "G65 P10 A1\nM30\nO10\nG0 X#1\nG65 P11 A[#1+1]\nY#1\nM99\nO11\nX#1\nM99\n",
       {"rapid X1", "rapid X2", "rapid X2 Y1", "end 30"}},
      {"G66 calls after each block that moves until G67, but not at once",
       "G66 P10 A5\nG0 X1\nF100\nX2 Y1\nG67\nX3\nM30\nO10\nG91 G0 Z#1\nG90\nM99\n",
       {"rapid X1", "rapid X1 Z5", "rapid X2 Y1 Z5", "rapid X2 Y1 Z10", "rapid X3 Y1 Z10", "end 30"}},
      {"a second G66 takes the place of the first",
       "G66 P10\nG66 P11\nG0 X1\nG67\nM30\nO10\nY1\nM99\nO11\nZ1\nM99\n",
       {"rapid X1", "rapid X1 Z1", "end 30"}},
      {"moves in a subprogram are followed by the modal call too",
       "G66 P10\nM98 P20\nG67\nM30\nO10\nG91 G0 Z1\nG90\nM99\nO20\nG0 X1\nX2\nM99\n",
       {"rapid X1", "rapid X1 Z1", "rapid X2 Z1", "rapid X2 Z2", "end 30"}},
      {"AR tells what was given, and whether in G90 or G91",
       "G91\nG65 P10 A0\nG90\nG65 P10 B1\nM30\nO10\nG90 G0 X[AR[#1]] Y[AR[#2]] Z[AR[#3]]\nM99\n",
       {"rapid X91", "rapid Y90", "end 30"}},
      {"M99 P returns to a block of the caller",
       "G0 X1\nM98 P10\nX2\nN7 X3\nM30\nO10\nN7 Y1\nM99 P7\n",
       {"rapid X1", "rapid X1 Y1", "rapid X3 Y1", "end 30"}},
      {"M99 P may return to before the call",
       "G0\nN7 X[#1+1]\n#1=#1+1\nIF[#1GE3]GOTO9\nM98 P10\nN9 M30\nO10\nM99 P7\n",
       {"rapid X1", "rapid X2", "rapid X3", "end 30"}},
      {"a jump stays in its program",
       "G0 X1\nM98 P10\nM30\nO10\nGOTO 5\nX2\nN5 X3\nM99\n",
       {"rapid X1", "rapid X3", "end 30"}},
      {"a message stops the program until it is read",
       "G0 X1\n#3006=12 (CHECK THE TOOL)\nX2\nM30\n",
       {"rapid X1", "message 12", "M0", "rapid X2", "end 30"}},
  };
}

TEST(MacroCall, GoldenPrograms) {
  for (const Golden& golden : programs()) {
    TestMachine machine;
    EXPECT_THAT(stream(run(machine, golden.program)), ElementsAreArray(golden.commands)) << golden.rule;
  }
}

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

TEST(MacroCall, ExampleOfEveryCallCodeIsAcceptedAndOtherNumbersAreRefused) {
  TestMachine machine = machine_with_cycles();
  for (const CallCode& code : call_codes) {
    const Interpretation result = run(machine, code.example);
    EXPECT_EQ(result.last, Step::end) << code.example << ": " << result.alarm.text.data();
    EXPECT_NE(std::string(code.example).find("G" + std::to_string(code.first).substr(0, 2)),
              std::string::npos);
    EXPECT_STRNE(code.meaning, "");
  }
  const auto called = [](int number) {
    for (const CallCode& code : call_codes) {
      if (number >= code.first && number <= code.last) return true;
    }
    return false;
  };
  // Every G to G2100 in steps of a tenth: what no table names is unknown, and nothing else is.
  for (std::uint32_t tenths = 0; tenths <= 21000; ++tenths) {
    const bool whole = tenths % 10 == 0;
    const bool known = g_code(tenths) != nullptr || (whole && called(static_cast<int>(tenths / 10)));
    const std::string number = std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
    const Interpretation result = run(machine, "G" + number + "\n");
    EXPECT_EQ(result.alarm.number == AlarmNumber::unknown_g, !known) << "G" << number;
  }
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

}  // namespace
}  // namespace trunnion::language::test
