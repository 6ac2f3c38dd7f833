// SPDX-License-Identifier: Apache-2.0
// Statements, types, variables and units of Structured Text.
#include <gmock/gmock.h>

#include <random>
#include <tuple>

#include "translated.hpp"

namespace trunnion::st {
namespace {

TEST(Statements, IfTakesTheFirstBranchThatIsTrue) {
  Translated program("VAR i, r : INT; END_VAR",
                     "IF i > 10 THEN r := 1; ELSIF i > 5 THEN r := 2; ELSE r := 3; END_IF;");
  for (const auto& [in, out] : {std::pair{"11", "1"}, {"10", "2"}, {"6", "2"}, {"5", "3"}}) {
    program.set("i", in);
    program.scan();
    EXPECT_EQ(program.get("r"), out) << in;
  }
}

TEST(Statements, CaseHasValuesRangesAndEnumeratedValues) {
  // 5 * 4 is 20, 27 MOD 4 + 40 is 43.
  Translated program("VAR i, r : INT; c : Color; s : STRING; END_VAR VAR CONSTANT k : INT := 4; END_VAR",
                     "CASE i OF -1: r := 1; 3, 5..7: r := 2; 5 * k: r := 4; 27 MOD k + 40: r := 5;\n"
                     "ELSE r := 3; END_CASE;\n"
                     "CASE c OF red: s := 'r'; Color#green, blue: s := 'gb'; END_CASE;",
                     "TYPE Color : (red, green, blue); END_TYPE\n");
  for (const auto& [in, out] : {std::pair{"-1", "1"},
                                {"3", "2"},
                                {"4", "3"},
                                {"5", "2"},
                                {"7", "2"},
                                {"8", "3"},
                                {"20", "4"},
                                {"43", "5"}}) {
    program.set("i", in);
    program.scan();
    EXPECT_EQ(program.get("r"), out) << in;
  }
  EXPECT_EQ(program.get("s"), "'r'");
  program.set("c", "blue");
  program.scan();
  EXPECT_EQ(program.get("s"), "'gb'");
}

// What begins the statements of a case is no label, though a colon follows: CASE n OF 0:
TEST(Statements, CaseStandsDirectlyInCase) {
  Translated program("VAR i, n, r : INT; END_VAR",
                     "CASE i OF\n"
                     "  0: CASE n OF 0: r := 1; 1, 2: r := 2; ELSE r := 3; END_CASE;\n"
                     "  1: CASE -n OF -1: CASE n + i OF 2: r := 4; END_CASE; END_CASE;\n"
                     "  ELSE CASE n OF 7: r := 5; END_CASE;\n"
                     "END_CASE;");
  for (const auto& [i, n, r] : {std::tuple{"0", "0", "1"},
                                {"0", "2", "2"},
                                {"0", "5", "3"},
                                {"1", "1", "4"},
                                {"2", "7", "5"},
                                {"2", "1", "5"}}) {
    program.set("i", i), program.set("n", n);
    EXPECT_EQ(program.scan(), "");
    EXPECT_EQ(program.get("r"), r) << i << " " << n;
  }
}

TEST(Statements, LoopsCountExitAndContinue) {
  Translated program(
      "VAR i, sum, down, w, r, odd, found : INT; u : USINT; n : DINT; END_VAR",
      "FOR i := 1 TO 10 DO sum := sum + i; END_FOR;\n"                      // 55
      "FOR i := 10 TO 1 BY -3 DO down := down * 10 + i MOD 10; END_FOR;\n"  // 10, 7, 4, 1: 0741
      "WHILE w < 5 DO w := w + 2; END_WHILE;\n"
      "REPEAT r := r + 1; UNTIL r >= 3 END_REPEAT;\n"
      "FOR i := 1 TO 9 DO IF i MOD 2 = 0 THEN CONTINUE; END_IF; odd := odd + 1; END_FOR;\n"
      "FOR found := 1 TO 9 DO IF found * found = 49 THEN EXIT; END_IF; END_FOR;\n"
      "FOR u := 0 TO 255 DO n := n + 1; END_FOR;");  // the type ends where the loop does
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("sum"), "55");
  EXPECT_EQ(program.get("down"), "741");
  EXPECT_EQ(program.get("w"), "6");
  EXPECT_EQ(program.get("r"), "3");
  EXPECT_EQ(program.get("odd"), "5");
  EXPECT_EQ(program.get("found"), "7");
  EXPECT_EQ(program.get("n"), "256");
}

TEST(Statements, ReturnLeavesTheUnit) {
  Translated program("VAR a, b : INT; END_VAR", "a := 1; IF a = 1 THEN RETURN; END_IF; b := 1;");
  program.scan();
  EXPECT_EQ(program.get("b"), "0");
}

TEST(Statements, TheStepOfALoopMayBeAVariable) {
  Translated program("VAR i, step, n : INT; END_VAR",
                     "n := 0; FOR i := 0 TO step * 3 BY step DO n := n + 1; END_FOR;");
  for (const char* step : {"2", "-2"}) {
    program.set("step", step);
    EXPECT_EQ(program.scan(), "");
    EXPECT_EQ(program.get("n"), "4") << step;
  }
}

TEST(Expressions, AndOrDoNotEvaluateWhatMustNotBe) {
  Translated program("VAR i : INT := 9; a : ARRAY[0..3] OF BOOL; hit : BOOL; END_VAR",
                     "hit := i < 4 AND a[i]; hit := i >= 4 OR a[i];");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("hit"), "TRUE");
}

TEST(Types, ArraysHaveAnyLimitsAndDimensions) {
  Translated program(
      "VAR a : ARRAY[-1..1, 2..3] OF INT := [1, 2, 2(5), 6]; i, j, sum : INT; s : ARRAY[1..2] OF ARRAY[1..2] "
      "OF INT; END_VAR",
      "FOR i := -1 TO 1 DO FOR j := 2 TO 3 DO sum := sum + a[i, j]; END_FOR; END_FOR;\n"
      "i := 1; a[i, 2] := 40; s[i][2] := 7;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("sum"), "19");  // 1 + 2 + 5 + 5 + 6 + 0
  EXPECT_EQ(program.get("a"), "[1, 2, 5, 5, 40, 0]");
  EXPECT_EQ(program.get("s"), "[[0, 7], [0, 0]]");
}

TEST(Types, EnumerationsHaveATypedValueAndAFirstValueOfTheirOwn) {
  Translated program(
      "VAR c : Colour; t : Signal; d : Colour := red; is_green, is_go : BOOL; END_VAR",
      "is_green := c = Colour#green; is_go := t = Signal#green; t := Signal#stop; c := SEL(is_green, c, "
      "red);",
      "TYPE Colour : (red, green) := green; Signal : (stop := 5, green := 7) := Signal#green; END_TYPE\n");
  EXPECT_EQ(program.get("c"), "green");
  EXPECT_EQ(program.get("d"), "red");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("is_green"), "TRUE");
  EXPECT_EQ(program.get("is_go"), "TRUE");
  EXPECT_EQ(program.get("t"), "stop");
  EXPECT_EQ(program.get("c"), "red");
}

TEST(Types, BitStringsHaveTypedLiterals) {
  Translated program("VAR a, b : BOOL; c : BYTE; d : WORD; e : DWORD; f : LWORD; END_VAR",
                     "a := BOOL#1; b := BOOL#FALSE; c := BYTE#2#1010_1010; d := NOT WORD#16#FF;\n"
                     "e := SHL(DWORD#8#17, 4); f := LWORD#16#FFFF_FFFF_FFFF_FFFF;");
  program.set("b", "TRUE");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("a"), "TRUE");
  EXPECT_EQ(program.get("b"), "FALSE");
  EXPECT_EQ(program.get("c"), "170");
  EXPECT_EQ(program.get("d"), "65280");  // 16#FF00
  EXPECT_EQ(program.get("e"), "240");    // 15 * 16
  EXPECT_EQ(program.get("f"), "18446744073709551615");
}

TEST(Types, StructuresAreCopiedAsAWhole) {
  Translated program(
      "VAR p, q : Point := (x := 1.5, name := 'one'); a : ARRAY[1..2] OF Point; i : INT := 2; END_VAR",
      "a[i] := p; a[i].y := 3.0; q := a[2];",
      "TYPE Point : STRUCT x, y : LREAL; name : STRING[5]; END_STRUCT; END_TYPE\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("q"), "(x := 1.5, y := 3.0, name := 'one')");
  EXPECT_EQ(program.get("a[1]"), "(x := 0.0, y := 0.0, name := '')");
  EXPECT_EQ(program.get("p.y"), "0.0");
}

TEST(Types, SubrangesAreChecked) {
  Translated program("VAR p : INT (0..100); v : INT; END_VAR", "p := v;");
  program.set("v", "100");
  EXPECT_EQ(program.scan(), "");
  program.set("v", "101");
  EXPECT_EQ(program.scan(), "t.st:3:1: value 101 is outside 0 .. 100 of the type");
  EXPECT_EQ(program.get("p"), "100");
}

TEST(Types, StringsAreCutAtTheirLength) {
  Translated program("VAR s : STRING[4] := 'abcdef'; t : STRING; END_VAR", "t := CONCAT(s, 'XY'); s := t;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("t"), "'abcdXY'");
  EXPECT_EQ(program.get("s"), "'abcd'");
}

TEST(Types, PartsOfBitStringsAreReadAndWritten) {
  Translated program(
      "VAR d : DWORD := 16#12345678; b : BYTE; w : WORD; x : BOOL; a : ARRAY[0..1] OF WORD; i : INT := 1; "
      "END_VAR",
      "b := d.%B1; w := d.%W1; x := d.%X3; d.%B0 := 16#FF; d.%X31 := TRUE; a[i].%X15 := TRUE;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("b"), std::to_string(0x56));
  EXPECT_EQ(program.get("w"), std::to_string(0x1234));
  EXPECT_EQ(program.get("x"), "TRUE");
  EXPECT_EQ(program.get("d"), std::to_string(0x923456FFu));
  EXPECT_EQ(program.get("a"), "[0, 32768]");
}

TEST(Types, LiteralsOfEveryKind) {
  Translated program(
      "VAR a : INT := 16#7F; b : INT := 2#1010_1010; c : INT := 8#17; d : LREAL := 1.5e-3; e : TIME := "
      "T#1d2h3m4s5ms;\n"
      "f : STRING := 'a$'b$N$41'; g : INT := INT#-5; h : DATE := D#2024-02-29; i : TOD := TOD#01:02:03.5; j "
      ": LTIME := LT#5us20ns;\n"
      "k : BOOL := BOOL#1; l : TIME := T#-2.5s; m : ULINT := 18446744073709551615; n : WORD := WORD#16#FFFF; "
      "END_VAR",
      "");
  for (const auto& [name, value] : {std::pair{"a", "127"},
                                    {"b", "170"},
                                    {"c", "15"},
                                    {"d", "0.0015"},
                                    {"e", "T#1d2h3m4s5ms"},
                                    {"f", "'a'b\nA'"},
                                    {"g", "-5"},
                                    {"h", "D#2024-02-29"},
                                    {"i", "TOD#01:02:03.500000000"},
                                    {"j", "LT#5us20ns"},
                                    {"k", "TRUE"},
                                    {"l", "T#-2s500ms"},
                                    {"m", "18446744073709551615"},
                                    {"n", "65535"}})
    EXPECT_EQ(program.get(name), value) << name;
}

// Comments of one kind nest, the other kind and // mean nothing in them (IEC 61131-3:2013, table 3).
TEST(Comments, Nest) {
  Translated program("VAR a, b, c, d, e : INT; END_VAR",
                     "a := 1; (* b := 1; (* c := 1; (**) *) d := 1; // *) b := 2;\n"
                     "/* c := 1; /* d := 1; (* */ e := 1;\n */ c := 3; (*/* *) d := 4; /*(* */ e := 5;");
  EXPECT_EQ(program.scan(), "");
  for (const auto& [name, value] : {std::pair{"a", "1"}, {"b", "2"}, {"c", "3"}, {"d", "4"}, {"e", "5"}})
    EXPECT_EQ(program.get(name), value) << name;
}

TEST(Registers, AreReadAndWrittenWithTheirWidth) {
  Translated program(
      "VAR lamp AT %Y3.1 : BOOL; word AT %G300 : INT; raw AT %G300 : WORD; kept AT %B7 : DINT; own AT %D4 : "
      "DINT; i : INT; END_VAR",
      "lamp := reset_button; word := -2; i := word; kept := kept - 1; own := own + 2; %R5.7 := TRUE; %QX4.0 "
      ":= %IX0.1;");
  program.set("%X0.1", "TRUE");
  program.set("%Y3.0", "TRUE");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("%Y3"), "3");
  EXPECT_EQ(program.get("%G300"), "65534");
  EXPECT_EQ(program.get("i"), "-2");
  EXPECT_EQ(program.get("%B7"), "-1");
  EXPECT_EQ(program.get("own"), "2");
  EXPECT_EQ(program.get("%R5"), "128");
  EXPECT_EQ(program.get("%Y4.0"), "TRUE");
  std::size_t written = 0;
  for (const auto& used : program.compilation.code->registers) written += used.written ? 1 : 0;
  EXPECT_EQ(program.compilation.code->registers.size(), 7u);  // X0, Y3, Y4, G300, R5, B7
  EXPECT_EQ(written, 6u);                                     // all but X0
}

// However a run is divided, it computes the same, and its parts together are as long. Loops and calls are
// interrupted too.
TEST(Machine, ARunInPartsIsTheSameRun) {
  const auto compiled = compile(
      {{"t.st",
        "FUNCTION twice : DINT VAR_INPUT v : DINT; END_VAR twice := v; twice := twice + v; END_FUNCTION\n"
        "FUNCTION_BLOCK Sum VAR_INPUT v : DINT; END_VAR VAR_OUTPUT s : DINT; END_VAR VAR i : INT; END_VAR\n"
        "FOR i := 1 TO 7 DO s := s + twice(v + i); END_FOR; END_FUNCTION_BLOCK\n"
        "PROGRAM main VAR x, y, n : DINT; b : Sum; a : ARRAY[0..4] OF DINT; END_VAR\n"
        "n := n + 1; b(v := n); x := b.s; WHILE y < n * 3 DO y := y + 1; a[y MOD 5] := x; END_WHILE;\n"
        "x := twice(x) - y; END_PROGRAM\n"}},
      interface_registers());
  ASSERT_TRUE(compiled.good()) << testing::PrintToString(compiled.lines());
  std::mt19937_64 random(9);
  Machine whole(compiled.code), parts(compiled.code);
  for (int run = 0; run < 200; ++run) {
    ASSERT_EQ(whole.run(0, 0, 100000).kind, FaultKind::none);
    Progress progress;
    std::int64_t statements = 0;
    int times = 0;
    do {
      ASSERT_EQ(parts.run_part(0, 0, 100000, 1 + static_cast<std::int64_t>(random() % 40), progress).kind,
                FaultKind::none);
      statements += parts.statements();
      ++times;
    } while (progress.interrupted != 0);
    EXPECT_EQ(statements, whole.statements());
    EXPECT_GT(times, 1);
    ASSERT_TRUE(std::equal(whole.memory().begin(), whole.memory().end(), parts.memory().begin()));
  }
}

TEST(Machine, ARunInPartsHasTheBudgetOfTheWholeRunAndRefusesAPlaceOfOtherCode) {
  const auto compiled = compile(
      {{"t.st", "PROGRAM main VAR n : DINT; END_VAR WHILE TRUE DO n := n + 1; END_WHILE; END_PROGRAM"}},
      interface_registers());
  ASSERT_TRUE(compiled.good());
  Machine machine(compiled.code);
  Progress progress;
  int parts = 1;
  Fault fault;
  while ((fault = machine.run_part(0, 0, 1000, 50, progress)).kind == FaultKind::none) ++parts;
  EXPECT_EQ(fault.kind, FaultKind::budget);
  EXPECT_EQ(fault.value, 1000);
  EXPECT_EQ(parts, 20);  // 1000 / 50
  EXPECT_EQ(progress, Progress{});
  progress.interrupted = 1, progress.instruction = 1u << 30;
  EXPECT_EQ(machine.run_part(0, 0, 1000, 50, progress).kind, FaultKind::none);
}

TEST(Units, FunctionsBeginWithTheirInitialValuesAndHaveOutputs) {
  const std::string function =
      "FUNCTION divided : INT\nVAR_INPUT a : INT; b : INT := 10; END_VAR\nVAR_OUTPUT rest : INT; "
      "END_VAR\nVAR n : INT; t : ARRAY[1..9] OF INT; END_VAR\n"
      "n := n + 1; t[9] := t[9] + 1; divided := a / b * n * t[9]; rest := a MOD b;\nEND_FUNCTION\n";
  Translated program("VAR q, r, s : INT; END_VAR",
                     "q := divided(47, 5, rest => r); s := divided(a := divided(b := 2, a := 100));",
                     function);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("q"), "9");
  EXPECT_EQ(program.get("r"), "2");
  EXPECT_EQ(program.get("s"), "5");
}

TEST(Units, InOutIsTheCallersVariable) {
  const std::string before =
      "FUNCTION swap\nVAR_IN_OUT a, b : INT; END_VAR\nVAR t : INT; END_VAR\nt := a; a := b; b := "
      "t;\nEND_FUNCTION\n"
      "FUNCTION_BLOCK Sum\nVAR_IN_OUT list : ARRAY[0..3] OF INT; END_VAR\nVAR_OUTPUT total : INT; "
      "END_VAR\nVAR i : INT; END_VAR\n"
      "total := 0; FOR i := 0 TO 3 DO total := total + list[i]; END_FOR; list[0] := "
      "total;\nEND_FUNCTION_BLOCK\n";
  Translated program(
      "VAR x : INT := 1; a : ARRAY[0..3] OF INT := [1, 2, 3, 4]; i : INT := 2; s : Sum; t : INT; END_VAR",
      "swap(x, a[i]); s(list := a, total => t);", before);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("x"), "3");
  EXPECT_EQ(program.get("t"), "8");  // 1 + 2 + 1 + 4
  EXPECT_EQ(program.get("a"), "[8, 2, 1, 4]");
}

TEST(Units, BlocksKeepTheirStateAndNest) {
  const std::string before =
      "FUNCTION_BLOCK Count\nVAR_INPUT add_n : INT := 1; END_VAR\nVAR_OUTPUT n : INT; END_VAR\nVAR_TEMP t : "
      "INT "
      ":= 5; END_VAR\n"
      "t := t + 1; n := n + add_n + t - 6;\nEND_FUNCTION_BLOCK\n"
      "FUNCTION_BLOCK Pair\nVAR a, b : Count; END_VAR\nVAR_OUTPUT sum : INT; END_VAR\na(); b(add_n := 10); "
      "sum "
      ":= a.n + b.n;\nEND_FUNCTION_BLOCK\n";
  Translated program("VAR p : ARRAY[1..2] OF Pair; i : INT := 2; s : INT; c : Count := (add_n := 3); END_VAR",
                     "p[i](); p[2](sum => s); c();", before);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("s"), "22");
  EXPECT_EQ(program.get("p[1].sum"), "0");
  EXPECT_EQ(program.get("c.n"), "3");
}

TEST(Units, GlobalsAreSharedDirectlyAndByExternal) {
  Translated program(
      "VAR_GLOBAL total : INT := 5; END_VAR\nVAR_GLOBAL CONSTANT size : INT := 3; END_VAR\n"
      "FUNCTION plus : INT\nVAR_EXTERNAL total : INT; END_VAR\nVAR_INPUT v : INT; END_VAR\ntotal := total + "
      "v; plus := total;\nEND_FUNCTION\n"
      "PROGRAM main\nVAR a : ARRAY[1..size] OF INT; x : INT; END_VAR\na[size] := total; x := total + plus(1) "
      "+ total;\nEND_PROGRAM\n",
      0);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("total"), "6");
  EXPECT_EQ(program.get("x"), "17");  // 5 before the call + 6 + 6 behind it
}

TEST(Faults, NameTheirPlace) {
  Translated program("VAR i : INT := 5; a : ARRAY[0..3] OF INT; END_VAR", "i := i;\n  a[0] := 1 + a[i];");
  EXPECT_EQ(program.scan(), "t.st:4:17: index 5 is outside 0 .. 3 of the array");
  Translated runaway("VAR i : INT; END_VAR", "WHILE i < 1 DO\n  ;\nEND_WHILE;");
  EXPECT_THAT(runaway.scan(), testing::HasSubstr("more than 1000000 statements in one run"));
}

TEST(Warnings, AreOfUnusedVariablesAndLostValues) {
  const auto result =
      compile({{"t.st",
                "PROGRAM main\nVAR a, b : INT; r : REAL; s : STRING[2]; END_VAR\na := DINT_TO_INT(40000);\nr "
                ":= 16777217;\ns := 'abc';\nSQRT(2.0);\nEND_PROGRAM\n"}},
              interface_registers());
  EXPECT_TRUE(result.good());
  EXPECT_THAT(result.lines(),
              testing::ElementsAre(
                  "t.st:2:8: warning: the variable 'b' is not used",
                  "t.st:3:6: warning: 40000 is outside -32768 .. 32767 of INT; the result is another number",
                  "t.st:4:6: warning: 16777217 is not exact as REAL (24 bits); use LREAL",
                  "t.st:5:6: warning: the string has 3 bytes, STRING[2] keeps 2",
                  "t.st:6:1: warning: the result of 'SQRT' is not used"));
}

TEST(Tests, PassOrNameThePlaceAndTheValues) {
  const auto result =
      compile({{"t.st",
                "TEST 'good'\nASSERT_EQ(1 + 1, 2); ASSERT_NEAR(0.1 + 0.2, 0.3, 1.0e-12);\nEND_TEST\n"
                "TEST bad\nVAR i : INT := 4; END_VAR\nASSERT_EQ(i, 5);\nEND_TEST\n"
                "PROGRAM main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
                "TEST 'program'\nmain(); main(); ASSERT_EQ(main.n, 2); main.n := 9; main(); "
                "ASSERT_TRUE(main.n = 10);\nEND_TEST\n"}},
              interface_registers());
  ASSERT_TRUE(result.good()) << testing::PrintToString(result.lines());
  const auto tests = run_tests(result);
  ASSERT_EQ(tests.size(), 3u);
  EXPECT_TRUE(tests[0].passed) << tests[0].message;
  EXPECT_FALSE(tests[1].passed);
  EXPECT_EQ(tests[1].message, "t.st:6:1: expected 5, found 4");
  EXPECT_TRUE(tests[2].passed) << tests[2].message;
}

}  // namespace
}  // namespace trunnion::st
