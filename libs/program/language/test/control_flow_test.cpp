// SPDX-License-Identifier: Apache-2.0
// Branches, loops and jumps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

TEST(ControlFlow, SkippedLinesAreNoPartOfTheStructure) {
  const char* program = "G0\n/IF 0\nX1\n/2 ENDIF\n/ENDIF\nX2\n/3 GOTO 9\nX3\nN9 M30\n";
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, program, {}, {}, {.block_skip = 0b011})),
              ElementsAre("rapid X1", "rapid X2", "end 30"));
  EXPECT_THAT(stream(run(machine, program, {}, {}, {.block_skip = 0b111})),
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "end 30"));
  EXPECT_THAT(stream(run(machine, "G0\n/IF 0\nX1\n/ENDIF\nX2\n", {}, {})), ElementsAre("rapid X2", "end 0"));
}

// Whether a jump leads behind the line or the branch before it leads to it.
TEST(ControlFlow, TextBehindElseAndTheEndsIsFoundWhereverTheProgramComesFrom) {
  struct Row {
    const char* program;
    const char* place;
  };
  for (const Row& row :
       {Row{"IF 0\nX1\nELSE X2\nENDIF", "alarm 1013 3:6"}, Row{"IF 1\nELSE X2\nENDIF", "alarm 1013 2:6"},
        Row{"IF 0\nX1\nENDIF (end) X2", "alarm 1013 3:13"}, Row{"WHILE 0\nX1\nN5 ENDW M5", "alarm 1013 3:9"},
        Row{"WHILE [0] DO 2\nX1\nEND 2.0 X2", "alarm 1013 3:9"},
        Row{"IF 0\nX1\nELSEIF 1 X2\nENDIF", "alarm 1013 3:10"},
        Row{"IF 0\nX1\nENDIF (open", "alarm 1004 3:7"}}) {
    TestMachine machine;
    EXPECT_THAT(stream(run(machine, row.program)), ElementsAre(row.place)) << row.program;
  }
  // Comments may be there, and a DO may be ended by a number with a point.
  for (const char* program :
       {"IF 0\nX1\nELSE (other) ; way\nX2\nENDIF ; end\nM30", "IF 0\nX1\nENDIF(end)\nX2\nM30",
        "DO2\nIF #1 EQ 1 GOTO 5\n#1=1\nEND2.0 (again)\nN5 X2\nM30",
        "WHILE [0] DO2\nX1\nEND 2. ; end\nX2\nM30"}) {
    TestMachine machine;
    EXPECT_THAT(stream(run(machine, program)), ElementsAre("rapid X2", "end 30")) << program;
  }
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
