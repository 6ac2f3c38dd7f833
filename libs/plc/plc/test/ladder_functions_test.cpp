// SPDX-License-Identifier: Apache-2.0
// MOV, DISAS and arithmetic with a target, as the ladder of the manuals has them.
#include <gmock/gmock.h>

#include "plcopen_documents.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

const char* const ladder_variables =
    "VAR d : DINT; u : UINT; i : INT; b : BOOL; r : REAL; by1 : BYTE; a : ARRAY[1..3] OF BYTE; w : WORD; "
    "END_VAR";

std::string value_after(const std::string& statements, const std::string& path) {
  Translated program(ladder_variables, statements);
  EXPECT_EQ(program.scan(), "") << statements;
  return program.get(path);
}

TEST(LadderFunctions, MoveKeepsTheLowBits) {
  EXPECT_EQ(value_after("d := -150; MOV(d, u);", "u"), "65386");            // 65536 - 150
  EXPECT_EQ(value_after("d := 70000; MOV(S := d, D => i);", "i"), "4464");  // 70000 - 65536
  EXPECT_EQ(value_after("u := 40000; MOV(u, d);", "d"), "40000");
  EXPECT_EQ(value_after("u := 40000; MOV(u, r);", "r"), "40000.0");
  EXPECT_EQ(value_after("d := -1; MOV(d, %W10);", "%W10"), "65535");
  EXPECT_EQ(value_after("d := MOV(7);", "d"), "7");
}

TEST(LadderFunctions, ArithmeticWritesItsTarget) {
  EXPECT_EQ(value_after("d := 30; u := 100; SUB(S1 := u, S2 := d, D => d);", "d"), "70");
  EXPECT_EQ(value_after("d := 65000; ADD(d, 1000, D => u);", "u"), "464");           // 66000 - 65536
  EXPECT_EQ(value_after("d := 300; MUL(S1 := d, S2 := d, D => u);", "u"), "24464");  // 90000 - 65536
  EXPECT_EQ(value_after("d := 17; DIV(d, 5, D => by1);", "by1"), "3");
  // Without a target they are the functions of the standard.
  EXPECT_EQ(value_after("d := ADD(1, 2, 3);", "d"), "6");
}

TEST(LadderFunctions, DisassemblyGivesBytesTheLowOneFirst) {
  EXPECT_EQ(value_after("%W50 := 16#1234; DISAS(2, %Y10, %W50);", "%Y10"), "52");  // 16#34
  EXPECT_EQ(value_after("%W50 := 16#1234; DISAS(2, %Y10, %W50);", "%Y11"), "18");  // 16#12
  EXPECT_EQ(value_after("d := -2; DISAS(N := 3, D => a, S := d);", "a"), "[254, 255, 255]");
  EXPECT_EQ(value_after("w := 16#ABCD; DISAS(1, by1, w);", "by1"), "205");
}

TEST(LadderFunctions, SayWhatIsWrong) {
  for (const auto& [statement, message] :
       {std::pair{"MOV(d, 5);", "t.st:3:8: error: a value cannot be written here: a variable is required"},
        {"MOV();", "t.st:3:1: error: MOV has the parameters S and D"},
        {"SUB(D => d);", "t.st:3:1: error: SUB with a target has the parameters S1, S2 and D"},
        {"DISAS(2, by1);", "t.st:3:1: error: DISAS has the parameters N, D and S"},
        {"DISAS(2, by1, w);", "t.st:3:10: error: there are fewer than 2 registers from here on"},
        {"DISAS(2, %Y511, w);", "t.st:3:10: error: there are fewer than 2 registers from here on"},
        {"DISAS(9, %Y10, w);", "t.st:3:7: error: DISAS gives 1 .. 8 bytes, not 9"},
        {"DISAS(2, %W10, w);",
         "t.st:3:10: error: DISAS writes registers of 8 bits, as %Y10, or an array of BYTE or USINT, not "
         "UINT"},
        {"DISAS(2, %Y10, r);", "t.st:3:16: error: DISAS is for integers and bit strings"}}) {
    const auto lines = compile({{"t.st", "PROGRAM main\n" + std::string(ladder_variables) + "\n" + statement +
                                             "\nEND_PROGRAM\n"}},
                               interface_registers())
                           .lines();
    EXPECT_THAT(lines, testing::Contains(message)) << statement;
  }
}

TEST(LadderFunctions, AreInstructionsToo) {
  const auto document = project(pou("main", "program", "",
                                    "<IL><xhtml>LD %X9.0\nCALC MOV(16#0102, %W50)\n"
                                    "CAL DISAS(2, %Y10, %W50)</xhtml></IL>"));
  const auto result = compile({{"l.xml", document}}, interface_registers());
  ASSERT_TRUE(result.good()) << testing::PrintToString(result.lines());
  SourceRun run(result);
  run.set("%X9.0", "TRUE");
  EXPECT_EQ(run.scan("").kind, FaultKind::none);
  EXPECT_EQ(run.get("%Y10"), "2");
  EXPECT_EQ(run.get("%Y11"), "1");
}

}  // namespace
}  // namespace trunnion::st
