// SPDX-License-Identifier: Apache-2.0
// O words of the LinuxCNC dialect: subroutines, branches, loops, numbered programs and the ends of a text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "language/endless_loop.hpp"
#include "linuxcnc_program.hpp"

namespace trunnion::language::test {
namespace {

using ::testing::ElementsAre;

TEST(LinuxcncFlow, ASubroutineIsPassedUntilItIsCalled) {
  EXPECT_THAT(linuxcnc_blocks("o100 sub\nG0 X#1 Y#2\no100 endsub\nX9\no100 call [1] [2+1]"),
              ElementsAre("rapid X9", "rapid X1 Y3"));
  // It may be behind the call, and has a name in either case, with blanks in it.
  EXPECT_THAT(linuxcnc_stream("O<My Sub> CALL\nM2\no<mysub> sub\nG0 X1\no<MYSUB> endsub\n"),
              ElementsAre("rapid X1", "end 2"));
  // A subroutine is found by a number that is computed.
  EXPECT_THAT(linuxcnc_blocks("o120 sub\nX1\no120 endsub\n#5=100\no[#5+20] call\n#6=120\no#6 call\nX2"),
              ElementsAre("rapid X1", "rapid X2"));
}

TEST(LinuxcncFlow, ParametersOfASubroutineAreItsOwn) {
  // #1 and #2 come back; of the call #2 is not given, so it is 0; #31 is common.
  EXPECT_THAT(linuxcnc_blocks("o1 sub\nG0 X#1 Y#2 Z#31\n#1=7 #2=8 #31=9\no1 endsub\n"
                              "#1=1 #2=2 #31=3\no1 call [5]\nX#1 Y#2 Z#31"),
              ElementsAre("rapid X5 Z3", "rapid X1 Y2 Z9"));
}

TEST(LinuxcncFlow, NamesAreLocalUnlessTheyBeginWithAnUnderscore) {
  EXPECT_THAT(linuxcnc_blocks("o1 sub\nG0 X#<_g> Y[EXISTS[#<a>]]\n#<a>=5 #<_g>=6\nX#<a>\no1 endsub\n"
                              "#<a>=2 #<_g>=3\no1 call\nX#<A> Y#<_g>"),
              ElementsAre("rapid X3", "rapid X5", "rapid X2 Y6"));
  // Each call begins without names, also of a numbered program and when it calls itself.
  EXPECT_THAT(linuxcnc_blocks("o1 sub\n#<n>=#1\no2 if [#1 GT 0]\no1 call [#1-1]\no2 endif\nG0 X#<n>\n"
                              "o1 endsub\no1 call [2]"),
              ElementsAre("rapid X1", "rapid X2"));
  EXPECT_THAT(
      linuxcnc_stream("#<a>=1\nM98 P5 L2\nX[EXISTS[#<a>]]\nM2\nO5\nX2 Y[EXISTS[#<a>]]\n#<a>=1\nM99\n"),
      ElementsAre("rapid X2", "rapid X1", "end 2"));
}

TEST(LinuxcncFlow, ASubroutineReturnsAValue) {
  EXPECT_THAT(linuxcnc_blocks("o1 sub\no2 if [#1 GT 0]\no1 return [#1*2]\no2 endif\no1 endsub [7]\n"
                              "o1 call [3]\nG0 X#<_value> Y#<_value_returned>\n"
                              "o1 call [0]\nX#<_value>"),
              ElementsAre("rapid X6 Y1", "rapid X7 Y1"));
  EXPECT_THAT(linuxcnc_blocks("o1 sub\no1 endsub [7]\no2 sub\no2 endsub\no1 call\no2 call\n"
                              "G0 X[#<_value>+1] Y[#<_value_returned>+1]"),
              ElementsAre("rapid X1 Y1"));
}

TEST(LinuxcncFlow, BranchesTakeTheFirstThatHolds) {
  for (int i = 0; i < 4; ++i) {
    const std::string program = "#1=" + std::to_string(i) +
                                "\no1 if [#1 EQ 0]\nX1\no1 elseif [#1 EQ 1]\no2 if [1]\nX2\no2 else\nX9\no2 "
                                "endif\no1 elseif [#1 EQ 2]\nX3\no1 else\nX4\no1 endif";
    EXPECT_THAT(linuxcnc_blocks(program), ElementsAre("rapid X" + std::to_string(i + 1))) << program;
  }
}

TEST(LinuxcncFlow, LoopsRepeat) {
  EXPECT_THAT(linuxcnc_blocks("#1=1\no1 while [#1 LE 3]\nG0 X#1\n#1=[#1+1]\no1 endwhile\nX9"),
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "rapid X9"));
  EXPECT_THAT(linuxcnc_blocks("o1 while [0]\nX1\no1 endwhile\nX2"), ElementsAre("rapid X2"));
  EXPECT_THAT(linuxcnc_blocks("#1=5\no1 do\nG0 X#1\n#1=[#1+1]\no1 while [#1 LT 7]\nY1"),
              ElementsAre("rapid X5", "rapid X6", "rapid X6 Y1"));
  EXPECT_THAT(linuxcnc_blocks("G91\no1 repeat [3]\nG0 X1\no1 endrepeat\no2 repeat [0]\nY1\no2 endrepeat"),
              ElementsAre("rapid X1", "rapid X2", "rapid X3"));
  // 2 times 2 times; the inner count begins anew.
  EXPECT_THAT(
      linuxcnc_blocks("G91\no1 repeat [2]\no2 repeat [2]\nX1\no2 endrepeat\nY1\no1 endrepeat"),
      ElementsAre("rapid X1", "rapid X2", "rapid X2 Y1", "rapid X3 Y1", "rapid X4 Y1", "rapid X4 Y2"));
}

TEST(LinuxcncFlow, BreakAndContinueLeaveTheLoopTheyName) {
  EXPECT_THAT(linuxcnc_blocks("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\n"
                              "o3 if [#1 EQ 4]\no1 break\no3 endif\nX#1\no1 endwhile\nX9"),
              ElementsAre("rapid X1", "rapid X3", "rapid X9"));
  EXPECT_THAT(linuxcnc_blocks("#1=0\no1 do\n#1=[#1+1]\no3 if [#1 EQ 2]\no1 continue\no3 endif\nX#1\n"
                              "o1 while [#1 LT 4]\nY1"),
              ElementsAre("rapid X1", "rapid X3", "rapid X4", "rapid X4 Y1"));
  // Out of the outer one of two.
  EXPECT_THAT(linuxcnc_blocks("o1 while [1]\no2 do\nX1\no1 break\nX2\no2 while [1]\nX3\no1 endwhile\nX4"),
              ElementsAre("rapid X1", "rapid X4"));
  EXPECT_THAT(linuxcnc_blocks("#1=0\no1 while [#1 LT 2]\n#1=[#1+1]\no2 do\nX#1\no1 continue\no2 while [1]\n"
                              "o1 endwhile\nX4"),
              ElementsAre("rapid X1", "rapid X2", "rapid X4"));
}

TEST(LinuxcncFlow, NumberedProgramsAreCalledByM98) {
  EXPECT_THAT(linuxcnc_stream("%\no1 (MAIN)\nG0 X1\nM98 P100 L2\nM98 P100 L0\nX9\nM30\n\no100\nG91 X1\nG90\n"
                              "M99\n%\n"),
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "rapid X9", "end 30"));
  // They share #1 to #30 with their caller.
  EXPECT_THAT(linuxcnc_stream("#1=1\nM98 P2\nX#1\nM2\nO2\n#1=[#1+4]\nM99\n"),
              ElementsAre("rapid X5", "end 2"));
  // A head that is no call is passed, and no number is split into repetitions and a program.
  EXPECT_THAT(linuxcnc_stream("X1\nO7\nX2\nM2\n"), ElementsAre("rapid X1", "rapid X2", "end 2"));
  EXPECT_THAT(linuxcnc_stream("M98 P20007\nM2\nO7\nX2\nM99\n"), ElementsAre("alarm 1401 1:5"));
}

TEST(LinuxcncFlow, WhatOnlyOtherControlsCallIsNoCall) {
  EXPECT_THAT(linuxcnc_blocks("M98 Q5\nN5 X1"), ElementsAre("alarm 1108 1:1"));
  EXPECT_THAT(linuxcnc_blocks("M98 P5 H2"), ElementsAre("alarm 1107 1:8"));
  // Codes that call programs of the machine are those of ISO programs.
  TestMachine machine = linuxcnc_machine();
  machine.calls.t = true;
  machine.calls.m[0] = 8;
  machine.cycle_m_codes[0] = 7;
  EXPECT_THAT(stream(run(machine, "T1 M6 M7 M8\nM2\n")), ElementsAre("T1", "M6", "M7", "M8", "M9", "end 2"));
}

TEST(LinuxcncFlow, CommentsMayBeInComments) {
  EXPECT_THAT(linuxcnc_blocks("(cut (3/16) )X1\n( a (b)) Y1"), ElementsAre("rapid X1", "rapid X1 Y1"));
  EXPECT_THAT(linuxcnc_messages("(MSG, hole (2))"), ElementsAre("hole (2)"));
  EXPECT_THAT(linuxcnc_blocks("(open"), ElementsAre("alarm 1004 1:1"));
}

TEST(LinuxcncFlow, FilesHoldSubroutines) {
  TestMachine machine = linuxcnc_machine();
  machine.programs["pocket"] = std::make_unique<StringSource>(
      "(a file)\no<pocket> sub\nG0 X#1\no<helper> call\no<pocket> endsub [#1+1]\nM2\n");
  machine.programs["O0123"] = std::make_unique<StringSource>("o123 sub\nX5\no<wrong> call\no123 endsub\n");
  EXPECT_THAT(
      stream(run(machine, "o<helper> sub\nY1\no<helper> endsub\no<Pocket> call [4]\nX#<_value>\nM2\n")),
      ElementsAre("rapid X4", "rapid X4 Y1", "rapid X5 Y1", "end 2"));
  const Interpretation missing = run(machine, "X1\no123 call\nM2\n");
  EXPECT_THAT(stream(missing), ElementsAre("rapid X1", "rapid X5", "alarm 1401 3:1"));
  EXPECT_EQ(missing.alarm.program, 123u);
  machine.programs["deep"] = std::make_unique<StringSource>("o<deep> sub\n\nX#<unknown>\no<deep> endsub\n");
  const Interpretation deep = run(machine, "o<deep> call\nM2\n");
  EXPECT_THAT(stream(deep), ElementsAre("alarm 1193 3:2"));
  EXPECT_STREQ(deep.alarm.file_name.data(), "deep");
  ASSERT_EQ(deep.alarm.calls, 1);
  EXPECT_EQ(deep.alarm.chain[0].line, 1u);
  EXPECT_EQ(deep.alarm.chain[0].file.front(), '\0');
  // No name leads out of the folder of the programs.
  machine.programs["../x"] = std::make_unique<StringSource>("o<../x> sub\nX1\no<../x> endsub\n");
  EXPECT_THAT(stream(run(machine, "o<../x> call\nM2\n")), ElementsAre("alarm 1401 1:1"));
}

TEST(LinuxcncFlow, WrongOWordsAreAlarms) {
  EXPECT_THAT(linuxcnc_blocks("o1 subroutine"), ElementsAre("alarm 1013 1:7"));
  EXPECT_THAT(linuxcnc_blocks("o1 goto"), ElementsAre("alarm 1196 1:1"));
  EXPECT_THAT(linuxcnc_blocks("o#1 if [1]\no#1 endif"), ElementsAre("alarm 1196 1:1"));
  EXPECT_THAT(linuxcnc_blocks("o<open call"), ElementsAre("alarm 1196 1:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 if [1]\nX1\no2 endif"), ElementsAre("rapid X1", "alarm 1404 3:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 if [0]\nX1\no2 endif"), ElementsAre("alarm 1404 3:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 if 1\no1 endif"), ElementsAre("alarm 1502 1:7"));
  EXPECT_THAT(linuxcnc_blocks("o1 break"), ElementsAre("alarm 1197 1:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 repeat [2]\no1 continue\no1 endrepeat"), ElementsAre("alarm 1197 2:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 return"), ElementsAre("alarm 1198 1:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 sub\nM99\no1 endsub\no1 call"), ElementsAre("alarm 1198 2:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 sub\no2 sub\no2 endsub\no1 endsub\no1 call"),
              ElementsAre("alarm 1199 1:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 call\nM2\no1 sub\no2 sub\no2 endsub\no1 endsub"),
              ElementsAre("alarm 1199 4:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 call\nM2\no1 sub\nX1\no9 endsub"),
              ElementsAre("rapid X1", "alarm 1198 5:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 call"), ElementsAre("alarm 1401 1:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 sub\no1 call\no1 endsub\no1 call"), ElementsAre("alarm 1402 2:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 sub\no1 endsub\no1 call X1"), ElementsAre("alarm 1013 3:9"));
  EXPECT_THAT(linuxcnc_blocks("G0 X1 o1 call"), ElementsAre("alarm 1012 1:7"));
  std::string call = "o1 call";
  for (int i = 0; i < 31; ++i) call += " [1]";
  EXPECT_THAT(linuxcnc_blocks(call), ElementsAre("alarm 1016 1:" + std::to_string(9 + 30 * 4)));
}

TEST(LinuxcncFlow, ATextEndsTheProgramAndSoDoesASecondPercent) {
  EXPECT_THAT(linuxcnc_stream("X1\nX2\n"), ElementsAre("rapid X1", "rapid X2", "end 0"));
  EXPECT_THAT(linuxcnc_stream("%\nX1\n%\nX2\n"), ElementsAre("rapid X1", "end 0"));
  // Nothing behind the second % belongs to the program.
  EXPECT_THAT(linuxcnc_stream("%\no1 call\n%\no1 sub\nX1\no1 endsub\n"), ElementsAre("alarm 1401 2:1"));
  EXPECT_THAT(linuxcnc_stream("% X1\nM2\n"), ElementsAre("alarm 1013 1:3"));
  EXPECT_THAT(linuxcnc_stream("o1 sub\nX1\n"), ElementsAre("alarm 1199 1:1"));
}

TEST(LinuxcncFlow, BlockDeleteHasOneLevel) {
  TestMachine machine = linuxcnc_machine();
  const std::string program = "/X1\n/o1 if [0]\nX2\n/o1 endif\nM2\n";
  EXPECT_THAT(stream(run(machine, program)), ElementsAre("rapid X1", "end 2"));
  EXPECT_THAT(stream(run(machine, program, {}, {}, {1, true})), ElementsAre("rapid X2", "end 2"));
  EXPECT_THAT(stream(run(machine, program, {}, {}, {2, true})), ElementsAre("rapid X1", "end 2"));
}

/// Whether the program is found to repeat for ever within some thousand lines.
bool repeats(const std::string& program) {
  TestMachine machine = linuxcnc_machine();
  StringSource source(program);
  EndlessLoop watch(false);
  Interpreter interpreter(machine, {0, false});
  interpreter.start(source, {}, {});
  interpreter.watch_loops(&watch);
  Command command;
  for (int i = 0; i < 100; ++i) {
    const Step step = interpreter.next(command);
    if (step == Step::end || step == Step::alarm) break;
  }
  return watch.line() != 0;
}

TEST(LinuxcncFlow, CountingWithNamesOrRepetitionsIsNoEndlessLoop) {
  EXPECT_TRUE(repeats("o1 while [1]\n#<a>=1\no1 endwhile\nM2\n"));
  EXPECT_FALSE(repeats("#<a>=0\no1 while [#<a> LT 3000]\n#<a>=[#<a>+1]\no1 endwhile\nM2\n"));
  EXPECT_FALSE(repeats("o1 repeat [3000]\n#1=1\no1 endrepeat\nM2\n"));
  EXPECT_FALSE(
      repeats("#<_a>=0\no2 sub\n#<_a>=[#<_a>+1]\no2 endsub\no1 while [#<_a> LT 900]\no2 call\no1 "
              "endwhile\nM2\n"));
}

}  // namespace
}  // namespace trunnion::language::test
