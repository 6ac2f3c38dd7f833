// SPDX-License-Identifier: Apache-2.0
// EN, ENO, inverted outputs and edges of inputs.
#include "translated.hpp"

namespace trunnion::st {
namespace {

TEST(Units, OutputsAreGivenInverted) {
  Translated program(
      "VAR off, same : BOOL; w : WORD; t : TON; list : ARRAY[0..1] OF BOOL; END_VAR",
      "both(a := TRUE, NOT q => off, NOT w => w); both(a := TRUE, q => same);\n"
      "t(IN := TRUE, PT := T#1s, NOT Q => list[1]);",
      "FUNCTION both VAR_INPUT a : BOOL; END_VAR VAR_OUTPUT q : BOOL := FALSE; w : WORD; END_VAR\n"
      "q := a; w := 16#00F0; END_FUNCTION\n");
  program.set("off", "TRUE");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("off"), "FALSE");
  EXPECT_EQ(program.get("same"), "TRUE");
  EXPECT_EQ(program.get("w"), "65295");  // 16#FF0F
  EXPECT_EQ(program.get("list"), "[FALSE, TRUE]");
}

// What EN switches off leaves its outputs and everything that it would change.
TEST(Units, AreExecutedWithEnOnly) {
  Translated program(
      "VAR on, ok, done, off, ready : BOOL; i, r, s, k : INT; m : REAL; text : STRING;\n"
      "a : ARRAY[0..3] OF INT; t : TON; blocks : ARRAY[0..1] OF Count; n : INT; END_VAR",
      "r := raised(EN := on, v := 4, out => k, ENO => ok); s := ADD(EN := on, 1, 2) + 10;\n"
      "m := SEL(ENO => done, EN := on, G := on, IN0 := 3, IN1 := 4);\n"
      "text := CONCAT('a', LEFT(EN := on, 'bc', 1));\n"
      "t(EN := on, IN := TRUE, PT := T#0s, Q => ready, NOT ENO => off);\n"
      "blocks[i](EN := i < 2, n => n); a[0] := raised(EN := i < 4, v := a[i]);",
      "VAR_GLOBAL calls : INT; END_VAR\n"
      "FUNCTION raised : INT VAR_INPUT v : INT; END_VAR VAR_OUTPUT out : INT; END_VAR\n"
      "calls := calls + 1; raised := v + 1; out := v; END_FUNCTION\n"
      "FUNCTION_BLOCK Count VAR_OUTPUT n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK\n");
  const auto shown = [&] {
    EXPECT_EQ(program.scan(), "");
    std::string text;
    for (const char* name : {"r", "s", "k", "m", "text", "n", "a", "calls", "ok", "done", "off", "ready"})
      text += program.get(name) + " ";
    return text;
  };
  program.set("k", "7"), program.set("i", "9"), program.set("ok", "TRUE");
  EXPECT_EQ(shown(), "0 10 7 0.0 'a' 0 [0, 0, 0, 0] 0 FALSE FALSE TRUE FALSE ");
  program.set("on", "TRUE"), program.set("i", "1");
  EXPECT_EQ(shown(), "5 13 4 4.0 'ab' 1 [1, 0, 0, 0] 2 TRUE TRUE FALSE TRUE ");
}

// The initial value of the 1000 cells is copied, not written by an instruction for each.
TEST(Units, WithEnGiveALargeResultByFewInstructions) {
  const auto translated = [](const std::string& value) {
    return Translated("VAR on : BOOL; a : List; END_VAR", "a := " + value + ";",
                      "TYPE List : ARRAY[0..999] OF INT := [1000(7)]; END_TYPE\n"
                      "FUNCTION filled : List filled[0] := 5; END_FUNCTION\n");
  };
  auto program = translated("filled(EN := on)");
  EXPECT_LT(program.compilation.code->code.size(), translated("filled()").compilation.code->code.size() + 30);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("a[0]"), "7");
  program.set("on", "TRUE");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("a[0]"), "5");
  EXPECT_EQ(program.get("a[999]"), "7");
}

// A unit that declares EN and ENO does with them what its body says.
TEST(Units, MayDeclareEnAndEnoThemselves) {
  Translated program(
      "VAR one : Own; list : ARRAY[0..1] OF Own; e, f : BOOL; i : INT; END_VAR",
      "one(EN := FALSE, ENO => e); list[1](EN := TRUE, NOT ENO => f); i := chosen(EN := TRUE);",
      "FUNCTION chosen : INT VAR_INPUT EN : BOOL; v : INT; END_VAR\n"
      "chosen := SEL(EN, 2, v + 3); END_FUNCTION\n"
      "FUNCTION_BLOCK Own VAR_INPUT EN : BOOL; END_VAR\n"
      "VAR_OUTPUT n : INT; ENO : BOOL; END_VAR\n"
      "n := n + 1; ENO := NOT EN; END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("one.n"), "1");
  EXPECT_EQ(program.get("e"), "TRUE");
  EXPECT_EQ(program.get("f"), "TRUE");
  EXPECT_EQ(program.get("i"), "3");
}

// The input is that of an R_TRIG or F_TRIG in the body; outside it is what the call has given.
TEST(Units, InputsDetectEdges) {
  Translated program("VAR x, given : BOOL; b : Count; n, m, both : INT; END_VAR",
                     "b(up := x, down := x, n => n); b(m => m, both => both); given := b.up;",
                     "FUNCTION_BLOCK Count\n"
                     "VAR_INPUT up : BOOL R_EDGE; down : BOOL F_EDGE; END_VAR\n"
                     "VAR_OUTPUT n, m, both : INT; END_VAR\n"
                     "VAR up_rising : INT; END_VAR\n"
                     "IF up THEN n := n + 1; up_rising := n; END_IF; IF down THEN m := m + 1; END_IF;\n"
                     "IF up OR down THEN both := up_rising * 10 + m; END_IF;\n"
                     "END_FUNCTION_BLOCK\n");
  // Two calls in each scan: the second one has the input of the first, so no edge. F_TRIG has one at its
  // first call.
  std::string up, down;
  for (const char c : std::string("0110100")) {
    program.set("x", std::string(1, c));
    EXPECT_EQ(program.scan(), "");
    up += program.get("n") + " ", down += program.get("m") + " ";
    EXPECT_EQ(program.get("given"), c == '1' ? "TRUE" : "FALSE");
  }
  EXPECT_EQ(up, "0 1 1 1 2 2 2 ");
  EXPECT_EQ(down, "1 1 1 2 2 3 3 ");
  EXPECT_EQ(program.get("both"), "23");
}

TEST(Tests, CallBlocksOfAProgramThatDeclareEn) {
  const auto result =
      compile({{"t.st",
                "FUNCTION_BLOCK Own VAR_INPUT EN : BOOL; END_VAR VAR_OUTPUT n : INT; END_VAR\n"
                "n := n + SEL(EN, 1, 10); END_FUNCTION_BLOCK\n"
                "PROGRAM main VAR o : Own; END_VAR o(EN := TRUE); END_PROGRAM\n"
                "TEST 'own'\nmain.o(EN := FALSE); ASSERT_EQ(main.o.n, 1);\nEND_TEST\n"}},
              interface_registers());
  ASSERT_TRUE(result.good()) << testing::PrintToString(result.lines());
  const auto tests = run_tests(result);
  ASSERT_EQ(tests.size(), 1u);
  EXPECT_TRUE(tests[0].passed) << tests[0].message;
}

}  // namespace
}  // namespace trunnion::st
