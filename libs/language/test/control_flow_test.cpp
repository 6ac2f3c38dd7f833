// Branches, loops and jumps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

std::vector<Golden> programs() {
  return {
      {"IF runs its blocks when the condition holds",
       "#1=2\nIF [#1 EQ 2]\nG0 X1\nENDIF\nX2\nM30\n",
       {"rapid X1", "rapid X2", "end 30"}},
      {"IF without brackets, as HNC writes it, with a comment",
       "G0\nIF #1 LT 0 ; vacant counts as 0\nX1\nENDIF\nX2\nM30\n",
       {"rapid X2", "end 30"}},
      {"the first condition that holds wins",
       "G0\n#1=2\nIF #1 EQ 1\nX1\nELSEIF #1 EQ 2\nX2\nELSEIF #1 EQ 2\nX3\nELSE\nX4\nENDIF\nX9\nM30\n",
       {"rapid X2", "rapid X9", "end 30"}},
      {"ELSE runs when none holds",
       "G0\nIF 0\nX1\nELSEIF 0 THEN\nX2\nELSE\nX3\nENDIF\nM30\n",
       {"rapid X3", "end 30"}},
      {"a condition behind the branch taken is not evaluated",
       "G0\nIF 1\nX1\nELSEIF 1/0\nX2\nENDIF\nM30\n",
       {"rapid X1", "end 30"}},
      {"inner branches are passed whole when the outer is not taken",
       "G0\nIF 0\nIF 1\nX1\nELSE\nX2\nENDIF\nWHILE 1\nX3\nENDW\nELSE\nIF 1 THEN\nX4\nENDIF\nENDIF\nM30\n",
       {"rapid X4", "end 30"}},
      {"ENDIF of an inner IF does not make the outer ELSEIF count",
       "G0\nIF 1\nIF 0\nX1\nENDIF\nELSEIF 1\nX2\nENDIF\nX3\nM30\n",
       {"rapid X3", "end 30"}},
      {"WHILE turns while its condition holds",
       "G0\n#1=0\nWHILE #1 LT 3\n#1=#1+1\nX#1\nENDW\nX9\nM30\n",
       {"rapid X1", "rapid X2", "rapid X3", "rapid X9", "end 30"}},
      {"WHILE DO with numbers nests",
       "G0\n#1=1\nWHILE[#1LE2]DO1\n#2=1\nWHILE[#2LE2]DO2\nX[10*#1+#2]\n#2=#2+1\nEND2\n#1=#1+1\nEND1\nM30\n",
       {"rapid X11", "rapid X12", "rapid X21", "rapid X22", "end 30"}},
      {"the same number may be used again",
       "G0\nWHILE[0]DO1\nX1\nEND1\nWHILE[0]DO1\nX2\nEND1\nX3\nM30\n",
       {"rapid X3", "end 30"}},
      {"DO without WHILE turns until a jump leaves it",
       "G0\nDO1\n#1=#1+1\nX#1\nIF[#1EQ2]GOTO 9\nEND1\nN9 X9\nM30\n",
       {"rapid X1", "rapid X2", "rapid X9", "end 30"}},
      {"IF GOTO forward", "G0\nIF[1EQ1]GOTO 20\nX1\nN20 X2\nM30\n", {"rapid X2", "end 30"}},
      {"IF GOTO whose condition does not hold goes on",
       "G0\nIF[1EQ2]GOTO 20\nX1\nN20 X2\nM30\n",
       {"rapid X1", "rapid X2", "end 30"}},
      {"GOTO backwards from the top",
       "G0\nN5 #1=#1+1\nX#1\nIF[#1LT3]GOTO 5\nM30\n",
       {"rapid X1", "rapid X2", "rapid X3", "end 30"}},
      {"GOTO looks forward first",
       "G0\nGOTO 20\nN10 X1\nN20 X2\nIF[#1EQ1]GOTO 99\n#1=1\nGOTO 10\nN10 X3\nN99 M30\n",
       {"rapid X2", "rapid X3", "end 30"}},
      {"GOTO a computed number",
       "G0\n#1=3\nGOTO #1\nN1 X1\nN2 X2\nN3 X3\nGOTO[#1+1]\nX4\nN4 M30\n",
       {"rapid X3", "end 30"}},
      {"N 10 and N0010 are the same", "G0\nGOTO 10\nX1\nn 0010 X2\nM30\n", {"rapid X2", "end 30"}},
      {"IF THEN with an assignment",
       "G0\nIF[1EQ1]THEN#1=5\nIF[1EQ2]THEN #1=6\nX#1\nM30\n",
       {"rapid X5", "end 30"}},
      {"IF THEN with words",
       "G0\nIF [1 EQ 1] THEN X1\nIF [1 EQ 2] THEN X2\nX3\nM30\n",
       {"rapid X1", "rapid X3", "end 30"}},
      {"IF THEN GOTO", "G0\nIF [1 EQ 1] THEN GOTO 3\nX1\nN3 X3\nM30\n", {"rapid X3", "end 30"}},
      {"a jump out of two loops leaves both, and the loop around turns on",
       "G0\n#1=0\nWHILE #1 LT 2\n#1=#1+1\nWHILE 1\nIF 1\nX#1\nGOTO 7\nENDIF\nENDW\nN7\nENDW\nX9\nM30\n",
       {"rapid X1", "rapid X2", "rapid X9", "end 30"}},
      {"a jump within a loop stays in it",
       "G0\nWHILE #1 LT 2\n#1=#1+1\nGOTO 5\nX8\nN5 X#1\nENDW\nM30\n",
       {"rapid X1", "rapid X2", "end 30"}},
      {"a jump back out of a loop, into which the program then comes again",
       "G0\nN1 #2=#2+1\n#1=0\nWHILE #1 LT 2\n#1=#1+1\nX[10*#2+#1]\nIF[[#1EQ1]AND[#2EQ1]]GOTO 1\nENDW\nM30\n",
       {"rapid X11", "rapid X21", "rapid X22", "end 30"}},
      {"M99 P in the main program jumps",
       "G0\nX1\n#1=#1+1\nIF[#1EQ2]GOTO 9\nM99 P5\nN5 X5\nM99\nN9 M30\n",
       {"rapid X1", "rapid X5", "rapid X1", "end 30"}},
      {"what is in comments counts for nothing",
       "G0\nIF 0 (THEN X1)\nX1 ;ENDIF\n(ENDIF)\nENDIF\nX2\nM30\n",
       {"rapid X2", "end 30"}},
  };
}

TEST(ControlFlow, GoldenPrograms) {
  for (const Golden& golden : programs()) {
    TestMachine machine;
    EXPECT_THAT(stream(run(machine, golden.program)), ElementsAreArray(golden.commands)) << golden.rule;
  }
}

TEST(ControlFlow, SameStreamFromPiecesOfAnySize) {
  struct Pieces : TextSource {
    Pieces(std::string_view text, std::size_t size) : whole(text), chunk(size) {}
    ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
      asked = !asked;
      if (asked) return {ReadStatus::pending, 0};
      return whole.read(offset, buffer, std::min(capacity, chunk));
    }
    StringSource whole;
    std::size_t chunk;
    bool asked = false;
  };
  for (const Golden& golden : programs()) {
    for (std::size_t chunk = 1; chunk < 9; ++chunk) {
      TestMachine machine;
      Pieces pieces(golden.program, chunk);
      EXPECT_THAT(stream(run(machine, pieces)), ElementsAreArray(golden.commands))
          << golden.rule << " " << chunk;
    }
  }
}

TEST(ControlFlow, SkippedLinesAreNoPartOfTheStructure) {
  const char* program = "G0\n/IF 0\nX1\n/2 ENDIF\n/ENDIF\nX2\n/3 GOTO 9\nX3\nN9 M30\n";
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, program, {}, {}, {.block_skip = 0b011})),
              ElementsAre("rapid X1", "rapid X2", "end 30"));
  EXPECT_THAT(stream(run(machine, program, {}, {}, {.block_skip = 0b111})),
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "end 30"));
  EXPECT_THAT(stream(run(machine, "G0\n/IF 0\nX1\n/ENDIF\nX2\n", {}, {})), ElementsAre("rapid X2", "end 0"));
}

TEST(ControlFlow, EndlessLoopsGiveTheThreadBack) {
  TestMachine machine;
  for (const char* program : {"WHILE 1\nENDW", "DO1\nEND1", "N1 GOTO 1", "N1\nIF 1 GOTO 1",
                              "WHILE[1]DO1\n#1=#1+1\nEND1", "M98 P1\nM30\nO1\nN3 GOTO 3\nM99", "N1 M99 P1"}) {
    StringSource source(program);
    Interpreter interpreter(machine);
    interpreter.start(source, {}, {});
    Command command;
    for (int i = 0; i < 20; ++i) EXPECT_EQ(interpreter.next(command), Step::working) << program;
  }
}

TEST(ControlFlow, LoopOverALongTextReadsItFromTheSourceOnceATurn) {
  // A million blocks inside a loop: more than any window holds.
  std::string text = "#1=0\nWHILE #1 LT 3\n#1=#1+1\n";
  for (int i = 0; i < 100000; ++i) text += "#2=#2+1\n";
  text += "ENDW\nG0 X[#2]\nM30\n";
  TestMachine machine;
  StringSource source(text);
  EXPECT_THAT(stream(run(machine, source)), ElementsAre("rapid X300000", "end 30"));
}

TEST(ControlFlow, MoreJumpsThanAreRememberedAreFoundAgain) {
  std::string text = "#1=0\nWHILE #1 LT 2\n#1=#1+1\n";
  for (int i = 0; i < 2000; ++i) text += "IF 0\n#3=1\nELSE\n#2=#2+1\nENDIF\n";
  text += "ENDW\nG0 X[#2] Y#3\nM30\n";
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, text)), ElementsAre("rapid X4000", "end 30"));
}

}  // namespace
}  // namespace trunnion::language::test
