// SPDX-License-Identifier: Apache-2.0
// Methods of function blocks.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "plc/machine/verify.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

std::string first_error_of(const std::string& text) {
  for (const auto& line : compile({{"t.st", text}}, interface_registers()).lines())
    if (line.find(": error: ") != std::string::npos) return line;
  return "";
}

constexpr const char* counter_block =
    "FUNCTION_BLOCK Counter\n"
    "VAR_OUTPUT n : INT; END_VAR VAR step : INT := 2; END_VAR\n"
    "METHOD PUBLIC raise : INT\n"
    "VAR_INPUT amount : INT := 3; END_VAR VAR_OUTPUT before : INT; END_VAR VAR_IN_OUT calls : INT; END_VAR\n"
    "VAR last : INT := 1; END_VAR\n"
    "before := n; last := last + amount * step; n := n + last; calls := calls + 1; raise := n;\n"
    "END_METHOD\n"
    "n := n + 100;\n"
    "END_FUNCTION_BLOCK\n";

// 1 + 3 * 2 = 7 with the initial value of the input, 1 + 5 * 2 = 11 with 5: `last` begins anew with every
// call.
TEST(Methods, UseTheVariablesOfTheirInstance) {
  Translated program("VAR c, d : Counter; a, b, e, w, calls, i : INT; list : ARRAY[0..1] OF Counter; END_VAR",
                     "a := c.raise(calls := calls, before => w); b := c.raise(5, calls);\n"
                     "e := list[i].raise(calls := calls); d(); i := d.n - 99;\n"
                     "list[i].raise(calls := calls, amount := 0);",
                     counter_block);
  EXPECT_EQ(verify(*program.compilation.code), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("a"), "7");
  EXPECT_EQ(program.get("w"), "0");
  EXPECT_EQ(program.get("b"), "18");
  EXPECT_EQ(program.get("c.n"), "18");
  EXPECT_EQ(program.get("e"), "7");
  EXPECT_EQ(program.get("list[0].n"), "7");
  EXPECT_EQ(program.get("list[1].n"), "1");
  EXPECT_EQ(program.get("d.n"), "100");
  EXPECT_EQ(program.get("calls"), "4");
}

TEST(Methods, HaveAFrameForEachCall) {
  Translated program("VAR b : B; r : INT; t : STRING; END_VAR",
                     "r := b.add(b.add(1, 2), b.add(b.add(3, 4), 5)) + b.add(1, 1);\n"
                     "t := CONCAT(b.text('a'), b.text('b'));",
                     "FUNCTION_BLOCK B\n"
                     "METHOD add : INT VAR_INPUT x, y : INT; END_VAR add := x + y; END_METHOD\n"
                     "METHOD text : STRING VAR_INPUT s : STRING; END_VAR text := CONCAT(s, s); END_METHOD\n"
                     "END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("r"), "17");
  EXPECT_EQ(program.get("t"), "'aabb'");
}

// SET: the parameter hides the variable n of the block, THIS.n is that of the block.
TEST(Methods, NameTheirInstanceWithThis) {
  Translated program("VAR o : Outer; b : B; END_VAR", "o(); b.set(5); b.other(b);",
                     "FUNCTION_BLOCK B VAR_OUTPUT n, m : INT; END_VAR VAR t : TON; END_VAR\n"
                     "METHOD set VAR_INPUT n : INT; END_VAR THIS.n := n; THIS^.twice(); twice();\n"
                     "THIS.t(IN := TRUE, PT := T#0s); IF t.Q THEN m := m + 1; END_IF; END_METHOD\n"
                     "METHOD PRIVATE twice n := n * 2; END_METHOD\n"
                     "METHOD other VAR_IN_OUT b : B; END_VAR m := m + b.n; END_METHOD\n"
                     "END_FUNCTION_BLOCK\n"
                     "FUNCTION_BLOCK Outer VAR inner : B; END_VAR THIS.inner.set(3); END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("b.n"), "20");
  EXPECT_EQ(program.get("b.m"), "21");  // the timer has ended, then the own n
  EXPECT_EQ(program.get("o.inner.n"), "12");
}

TEST(Methods, UseConstantsRegistersAndArraysOfTheirBlock) {
  Translated program("VAR b : B; x : INT := 4; END_VAR", "b(x := x);",
                     "FUNCTION_BLOCK B VAR_IN_OUT x : INT; END_VAR VAR CONSTANT k : INT := 10; END_VAR\n"
                     "VAR lamp AT %Y3.1 : BOOL; a : ARRAY[0..2] OF INT; END_VAR\n"
                     "METHOD step VAR_INPUT i : INT; END_VAR VAR_IN_OUT y : INT; END_VAR\n"
                     "a[i] := y + k; y := a[i]; lamp := y > k; END_METHOD\n"
                     "step(2, x);\n"
                     "END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("x"), "14");
  EXPECT_EQ(program.get("%Y3.1"), "TRUE");
}

TEST(Methods, AreExecutedWithEnOnly) {
  Translated program("VAR c : Counter; on, ok : BOOL; r, calls : INT; END_VAR",
                     "r := c.raise(EN := on, calls := calls, ENO => ok);", counter_block);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("c.n") + " " + program.get("ok"), "0 FALSE");
  program.set("on", "TRUE");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("c.n") + " " + program.get("ok") + " " + program.get("r"), "7 TRUE 7");
}

// The main task is interrupted within a method, and the fast task calls the same one.
TEST(Methods, ContinueBehindAnInterruptionWithTheirVariables) {
  const auto compiled =
      compile({{"t.st",
                "FUNCTION_BLOCK B METHOD sum : INT VAR_INPUT n : INT; END_VAR VAR i : INT; END_VAR\n"
                "FOR i := 1 TO n DO sum := sum + i; END_FOR; END_METHOD END_FUNCTION_BLOCK\n"
                "PROGRAM fast VAR b : B; r : INT; END_VAR r := b.sum(3); END_PROGRAM\n"
                "PROGRAM main VAR b : B; r : INT; END_VAR r := b.sum(50); END_PROGRAM\n"}},
              interface_registers());
  ASSERT_TRUE(compiled.good()) << testing::PrintToString(compiled.lines());
  const auto& entries = compiled.code->entries;
  const auto entry = [&](const char* name) {
    return static_cast<std::size_t>(
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == name; }) -
        entries.begin());
  };
  Machine machine(compiled.code);
  Progress progress;
  int parts = 0;
  do {
    ASSERT_EQ(machine.run_part(entry("MAIN"), 0, 100000, 7, progress).kind, FaultKind::none);
    ASSERT_EQ(machine.run(entry("FAST"), 0, 100000).kind, FaultKind::none);
    ++parts;
  } while (progress.interrupted != 0);
  EXPECT_GT(parts, 10);  // 50 runs of the loop are 100 statements
  const Variables variables(compiled);
  EXPECT_EQ(machine.memory()[variables.find("main.r").address], 1275u);  // 50 * 51 / 2
  EXPECT_EQ(machine.memory()[variables.find("fast.r").address], 6u);
}

TEST(Methods, AreRefusedWithOneClearLine) {
  const auto in_block = [](const std::string& text, const std::string& run = "") {
    return first_error_of("FUNCTION_BLOCK B VAR_OUTPUT q : INT; END_VAR VAR_TEMP t : INT; END_VAR\n" + text +
                          "\nEND_FUNCTION_BLOCK\nPROGRAM main VAR b : B; i : INT; END_VAR " + run +
                          " END_PROGRAM\n");
  };
  using testing::HasSubstr;
  EXPECT_EQ(in_block("METHOD m q := 1; END_METHOD", "b.m();"), "");
  EXPECT_EQ(in_block("METHOD PRIVATE m q := 1; END_METHOD", "b.m();"),
            "t.st:4:44: error: the method 'm' of 'B' is PRIVATE");
  EXPECT_THAT(in_block("METHOD PROTECTED m q := 1; END_METHOD", "b.m();"),
              HasSubstr("'m' of 'B' is PROTECTED"));
  EXPECT_THAT(in_block("METHOD a THIS.b(); END_METHOD METHOD b a(); END_METHOD"),
              HasSubstr("calls or contains itself; recursion is not permitted"));
  EXPECT_THAT(in_block("METHOD m q := t; END_METHOD"),
              HasSubstr("VAR_TEMP 't' has a value in the body of the function block only"));
  EXPECT_THAT(first_error_of("FUNCTION_BLOCK B VAR_IN_OUT x : INT; END_VAR METHOD m x := 1; END_METHOD "
                             "END_FUNCTION_BLOCK"),
              HasSubstr("VAR_IN_OUT 'x' is of calls of the body: pass the variable to the method"));
  EXPECT_THAT(in_block("METHOD m VAR RETAIN a : INT; END_VAR q := a; END_METHOD"),
              HasSubstr("a method keeps nothing: RETAIN is not permitted"));
  EXPECT_THAT(in_block("METHOD m VAR a : TON; END_VAR a(); END_METHOD"),
              HasSubstr("a method keeps nothing, so it cannot contain the function block 'a'"));
  EXPECT_THAT(in_block("METHOD q END_METHOD"), HasSubstr("'q' is a variable of 'B' already"));
  EXPECT_THAT(in_block("METHOD m END_METHOD METHOD m END_METHOD"),
              HasSubstr("the method 'm' is declared twice"));
  EXPECT_THAT(in_block("METHOD m : INT VAR_INPUT a : INT; END_VAR m := a; END_METHOD", "i := b.m();"),
              HasSubstr("'m' needs a value for 'a'"));
  EXPECT_THAT(in_block("METHOD m q := 1; END_FUNCTION_BLOCK"),
              HasSubstr("expected END_METHOD at the end of the method"));
  EXPECT_THAT(first_error_of("PROGRAM main THIS.a := 1; END_PROGRAM"),
              HasSubstr("THIS and SUPER are for function blocks and their methods"));
}

// Each method has the frames of the two calls in its statement among its own cells: 100 * 2^k cells.
TEST(Methods, AreRefusedWhenTheirVariablesNeedTooManyCells) {
  std::string text =
      "FUNCTION_BLOCK B METHOD m0 : INT VAR a : ARRAY[0..99] OF INT; END_VAR m0 := a[1]; END_METHOD\n";
  for (int k = 1; k < 16; ++k) {
    const auto name = "m" + std::to_string(k), other = "m" + std::to_string(k - 1);
    text += "METHOD " + name + " : INT " + name + " := " + other + "() + " + other + "(); END_METHOD\n";
  }
  EXPECT_THAT(first_error_of(text + "END_FUNCTION_BLOCK\n"),
              testing::HasSubstr(
                  "the variables of the methods that this statement calls need more than 1048576 cells"));
}

// A block without an instance is in the byte code, but its variables are not in the memory.
TEST(Methods, OfBlocksWithoutAnInstanceMayBeLargerThanTheMemory) {
  Translated program("VAR i : INT; END_VAR", "i := 1;",
                     "FUNCTION_BLOCK B VAR a : ARRAY[0..99999] OF INT; END_VAR\n"
                     "METHOD m : INT VAR b : ARRAY[0..99999] OF INT; END_VAR m := b[1] + a[1]; END_METHOD\n"
                     "a[0] := m(); END_FUNCTION_BLOCK\n");
  EXPECT_EQ(verify(*program.compilation.code), "");
  EXPECT_EQ(program.scan(), "");
  // The memory has the 11840 cells of the registers and few others; nothing executes the copy of 200000.
  Translated copies("VAR i : INT; END_VAR", "i := 1;",
                    "FUNCTION_BLOCK B VAR a, b : ARRAY[0..199999] OF INT; END_VAR b := a; "
                    "END_FUNCTION_BLOCK\n");
  EXPECT_EQ(verify(*copies.compilation.code), "");
  EXPECT_EQ(copies.scan(), "");
}

// They are no keywords elsewhere: programs of before may have such variables.
TEST(Methods, LeaveTheirWordsAsNames) {
  Translated program("VAR method, public, private, this, super : INT; END_VAR",
                     "method := 1; public := method + 1; private := public; this := private; super := this;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("super"), "2");
}

TEST(Methods, HaveTheirVariablesInTheCrossReference) {
  const auto compiled =
      compile({{"t.st", std::string(counter_block) +
                            "PROGRAM main VAR c : Counter; i : INT; END_VAR c.raise(calls := i); "
                            "END_PROGRAM\n"}},
              interface_registers());
  ASSERT_TRUE(compiled.good()) << testing::PrintToString(compiled.lines());
  std::map<std::string, std::size_t> uses;
  for (const auto& reference : compiled.references) uses[reference.name] = reference.uses.size();
  EXPECT_EQ(uses.at("Counter.n"), 6u);  // four in the method, two in the body
  EXPECT_EQ(uses.at("Counter.step"), 1u);
  EXPECT_EQ(uses.at("Counter.raise.last"), 3u);
}

}  // namespace
}  // namespace trunnion::st
