// SPDX-License-Identifier: Apache-2.0
// What programs of CoDeSys 2.3 have beyond the standard.
#include <gmock/gmock.h>

#include "translated.hpp"

namespace trunnion::st {
namespace {

std::vector<std::string> lines_of(const std::string& file, const std::string& text) {
  return compile({{file, text}}, interface_registers()).lines();
}

// IEC 61131-3:2013, table 17: w.%X3 is w.3.
TEST(Codesys, NamesABitByItsNumberAlone) {
  Translated program("VAR w : WORD; b : BOOL; END_VAR", "w.3 := TRUE; b := w.3 AND NOT w.%X2;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("main.w"), "8");
  EXPECT_EQ(program.get("main.b"), "TRUE");
}

TEST(Codesys, ReadsTheValuesOfAnArrayWithoutBrackets) {
  Translated program("VAR a : ARRAY[0..4] OF INT := 1, 2(7), -3; s : Row; END_VAR", "a[4] := s.r[2];",
                     "TYPE Row : STRUCT r : ARRAY[1..2] OF INT := 5, 6; END_STRUCT END_TYPE\n");
  EXPECT_EQ(program.scan(), "");
  const char* expected[] = {"1", "7", "7", "-3", "6"};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(program.get("main.a[" + std::to_string(i) + "]"), expected[i]);
}

TEST(Codesys, NeedsNoSemicolonBehindEndIf) {
  Translated program("VAR i : INT; END_VAR", "IF i = 0 THEN i := 1; END_IF i := i + 1;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("main.i"), "2");
}

TEST(Codesys, TakesAnOwnFunctionForALaterStandardOne) {
  const std::string own =
      "FUNCTION DAY_OF_WEEK : INT VAR_INPUT d : DATE; END_VAR DAY_OF_WEEK := 77; END_FUNCTION\n"
      "FUNCTION FLOOR : INT VAR_INPUT x : REAL; END_VAR FLOOR := 5; END_FUNCTION\n";
  Translated program("VAR i, f : INT; END_VAR", "i := DAY_OF_WEEK(D#2026-11-29); f := FLOOR(1.5);", own);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("main.i"), "77");
  EXPECT_EQ(program.get("main.f"), "5");
  EXPECT_THAT(
      lines_of("t.st", own),
      testing::Contains("t.st:1:10: warning: 'DAY_OF_WEEK' takes the place of the standard function"));
}

TEST(Codesys, TakesVarInputConstantAsAnInput) {
  Translated program("VAR a, b : INT; END_VAR", "a := twice(); b := twice(v := 4);",
                     "FUNCTION twice : INT VAR_INPUT CONSTANT v : INT := 3; END_VAR twice := 2 * v; "
                     "END_FUNCTION\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("main.a"), "6");
  EXPECT_EQ(program.get("main.b"), "8");
}

TEST(Codesys, RefusesPointersWithOneLineOfEachUnit) {
  const auto lines = lines_of("t.exp",
                              "FUNCTION f : INT VAR_INPUT p : POINTER TO ARRAY[0..9] OF INT; END_VAR\n"
                              "IF p^[1] > 0 THEN p^[1] := 0; END_IF; f := p^[2]; END_FUNCTION\n");
  EXPECT_THAT(lines, testing::ElementsAre(
                         "t.exp:1:32: error: there are no pointers and references; pass the variable as "
                         "VAR_IN_OUT, and take bytes of a string with MID"));
}

}  // namespace
}  // namespace trunnion::st
