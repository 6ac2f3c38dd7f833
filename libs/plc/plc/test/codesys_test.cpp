// SPDX-License-Identifier: Apache-2.0
// What programs of CoDeSys 2.3 have beyond the standard, and its rules for operands in its exports.
#include <gmock/gmock.h>

#include <optional>

#include "translated.hpp"

namespace trunnion::st {
namespace {

std::vector<std::string> lines_of(const std::string& file, const std::string& text) {
  return compile({{file, text}}, interface_registers()).lines();
}

/// The variables of PROGRAM main of an export after one scan.
class Export {
 public:
  Export(const std::string& declarations, const std::string& statements, const std::string& before = "")
      : compilation(compile({{"t.exp", before + "PROGRAM main VAR " + declarations + " END_VAR " +
                                           statements + "\nEND_PROGRAM\n"}},
                            interface_registers())) {
    if (!compilation.good()) throw std::runtime_error(testing::PrintToString(compilation.lines()));
    run.emplace(compilation);
    run->scan("");
  }
  std::string get(const std::string& name) const { return run->get("main." + name); }

 private:
  Compilation compilation;
  std::optional<SourceRun> run;
};

// IEC 61131-3:2013, table 17: w.%X3 is w.3.
TEST(Codesys, NamesABitByItsNumberAlone) {
  Translated program("VAR w : WORD; b : BOOL; END_VAR", "w.3 := TRUE; b := w.3 AND NOT w.%X2;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("main.w"), "8");
  EXPECT_EQ(program.get("main.b"), "TRUE");
}

// A bit of an integer is that of its two's complement: -1 without bit 0 is -2.
TEST(CodesysExport, HasBitsOfIntegers) {
  Export program("i : INT; d : DINT := -1; c : BOOL;", "i.15 := TRUE; c := d.31; d.0 := FALSE;");
  EXPECT_EQ(program.get("i"), "-32768");
  EXPECT_EQ(program.get("c"), "TRUE");
  EXPECT_EQ(program.get("d"), "-2");
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

// Of 10 bytes the first 8 are written as two DWORD. ADR(b) + 7 is 7 bytes behind ADR(b).
TEST(CodesysExport, KeepsPointersInNumbers) {
  Export program(
      "b : ARRAY[0..9] OF BYTE; done : BOOL; s : STRING(10) := 'aBc'; u : STRING(10); p : POINTER TO BYTE; d "
      ": "
      "DWORD; r : REAL := 1.0;",
      "done := fill(ADR(b), SIZEOF(b)); u := upper(s); p := ADR(b) + 7; d := p - ADR(b); p := ADR(r);",
      "FUNCTION fill : BOOL VAR_INPUT first : POINTER TO BYTE; size : UINT; END_VAR VAR w : POINTER TO "
      "DWORD; "
      "last : DWORD; END_VAR last := first; last := last + UINT_TO_DWORD(size); w := first;\n"
      "WHILE w + 3 < last DO w^ := 16#01020304; w := w + 4; END_WHILE first := w;\n"
      "WHILE first < last DO first^ := 9; first := first + 1; END_WHILE fill := TRUE; END_FUNCTION\n"
      "FUNCTION upper : STRING(10) VAR_INPUT s : STRING(10); END_VAR VAR p : POINTER TO BYTE; i : INT; "
      "END_VAR\n"
      "upper := s; p := ADR(upper); FOR i := 1 TO LEN(s) DO IF p^ > 96 THEN p^ := p^ - 32; END_IF p := p + "
      "1; "
      "END_FOR END_FUNCTION\n");
  EXPECT_EQ(program.get("b"), "[4, 3, 2, 1, 4, 3, 2, 1, 9, 9]");
  EXPECT_EQ(program.get("u") + " " + program.get("d"), "'ABC' 7");
}

// What is behind a pointer is read with the bytes of its own type, whatever it is computed in: of UDINT 4.
TEST(CodesysExport, ComputesWithWhatPointersReach) {
  Export program(
      "u : UDINT := 5; d : DWORD := 7; pu : POINTER TO UDINT; pd : POINTER TO DWORD; i, k : DINT; b : BOOL;",
      "pu := ADR(u); pd := ADR(d); i := -pu^; k := -pd^ + 1; b := pd^ > pu^;");
  EXPECT_EQ(program.get("i") + " " + program.get("k") + " " + program.get("b"), "-5 -6 TRUE");
}

// BYTE 200 + 100 is computed in 32 bits; of 300 a BYTE takes 300 - 256 = 44.
TEST(CodesysExport, ComputesWithBitStrings) {
  Export program(
      "b : BYTE := 200; c : BYTE; i : INT; w : WORD := 16#FFFF; d : DWORD := 16#FFFFFFFF; s : DINT;",
      "c := b + 100; i := b + 100; w := w AND i; s := d; d := SHL(i, 2) OR 1;");
  EXPECT_EQ(program.get("c"), "44");
  EXPECT_EQ(program.get("i"), "300");
  EXPECT_EQ(program.get("w"), "300");
  EXPECT_EQ(program.get("s"), "-1");
  EXPECT_EQ(program.get("d"), "1201");
}

// In the standard REAL and DWORD exchange their bits, and a date has no number.
TEST(CodesysExport, ConvertsByValue) {
  Export program("r : REAL; d, e : DWORD; day : DATE; t : TIME; f : TIME;",
                 "r := DWORD_TO_REAL(5) / BYTE_TO_REAL(2); d := REAL_TO_DWORD(2.5 + 1.0);"
                 "e := DATE_TO_DWORD(D#1970-01-03); day := DWORD_TO_DATE(86400);"
                 "t := T#1s + 500; f := DWORD_TO_TIME(TIME_TO_DWORD(t) / 3);");
  EXPECT_EQ(program.get("r"), "2.5");
  EXPECT_EQ(program.get("d"), "4");       // 3.5, halves to the even number
  EXPECT_EQ(program.get("e"), "172800");  // two days in s
  EXPECT_EQ(program.get("day"), "D#1970-01-02");
  EXPECT_EQ(program.get("t"), "T#1s500ms");
  EXPECT_EQ(program.get("f"), "T#500ms");
}

TEST(CodesysExport, WritesInputsAndUsesConstantsBeforeTheirDeclaration) {
  Export program("x : Limiter; y : INT;", "x(v := 12); y := x.q;",
                 "FUNCTION_BLOCK Limiter VAR_INPUT v : INT; END_VAR VAR_OUTPUT q : INT; END_VAR "
                 "VAR a : ARRAY[0..n] OF INT; END_VAR VAR CONSTANT n : INT := 9; END_VAR "
                 "IF v > n THEN v := n; END_IF a[n] := v; q := a[n]; END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.get("y"), "9");
}

TEST(CodesysExport, IsASourceOfAMachine) {
  EXPECT_TRUE(is_compiled("LIMITS.EXP"));
  EXPECT_TRUE(is_compiled("limits.exp"));
  EXPECT_FALSE(is_compiled("limits.export"));
}

TEST(CodesysExport, LeavesOtherFilesStrict) {
  const std::string text = "PROGRAM main VAR b : BYTE; i : INT; END_VAR i := b + 1; END_PROGRAM\n";
  EXPECT_TRUE(compile({{"t.exp", text}}, interface_registers()).good());
  EXPECT_FALSE(compile({{"t.st", text}}, interface_registers()).good());
}

}  // namespace
}  // namespace trunnion::st
