// SPDX-License-Identifier: Apache-2.0
// ARRAY[*]: arrays whose limits are those of the caller's.
#include <gmock/gmock.h>

#include <algorithm>

#include "plc/machine/verify.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

using testing::HasSubstr;

constexpr const char* open_functions =
    "TYPE Point : STRUCT x, y : INT; END_STRUCT; END_TYPE\n"
    "FUNCTION total : DINT VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR VAR i : INT; END_VAR\n"
    "FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO total := total + a[i]; END_FOR; END_FUNCTION\n"
    "FUNCTION twice : DINT VAR_INPUT f : INT; END_VAR VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR\n"
    "twice := f * total(a); END_FUNCTION\n"
    "FUNCTION number VAR_IN_OUT m : ARRAY[*, *] OF INT; END_VAR VAR i, j : INT; END_VAR\n"
    "FOR i := LOWER_BOUND(m, 1) TO UPPER_BOUND(m, 1) DO FOR j := LOWER_BOUND(m, 2) TO UPPER_BOUND(m, 2) DO\n"
    "m[i, j] := 10 * i + j; END_FOR; END_FOR; END_FUNCTION\n"
    "FUNCTION set_y VAR_IN_OUT p : ARRAY[*] OF Point; END_VAR VAR_INPUT i, v : INT; END_VAR p[i].y := v; "
    "END_FUNCTION\n";

TEST(OpenArrays, HaveTheLimitsOfTheCaller) {
  Translated program(
      "VAR a : ARRAY[-1..1] OF INT := [1, 2, 3]; b : ARRAY[10..11] OF INT := [4, 5]; r, s, t : DINT;\n"
      "m : ARRAY[1..2, -1..1] OF INT; p : ARRAY[2..4] OF Point; low, high : INT; END_VAR",
      "r := total(a); s := total(b); t := twice(2, a); number(m); set_y(p, 3, 7); set_y(p, 4, 8);\n"
      "low := LOWER_BOUND(m, 2); high := UPPER_BOUND(ARR := p, DIM := 1);",
      open_functions);
  EXPECT_EQ(verify(*program.compilation.code), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("r") + " " + program.get("s") + " " + program.get("t"), "6 9 12");
  EXPECT_EQ(program.get("m"), "[9, 10, 11, 19, 20, 21]");  // 10 * i + j
  EXPECT_EQ(program.get("p"), "[(x := 0, y := 0), (x := 0, y := 7), (x := 0, y := 8)]");
  EXPECT_EQ(program.get("low") + " " + program.get("high"), "-1 4");
}

TEST(OpenArrays, AreParametersOfBlocksAndMethods) {
  Translated program(
      "VAR a : ARRAY[1..3] OF INT := [1, 2, 3]; d : D; r : INT; i : I; END_VAR",
      "d(a := a); r := d.last(a); i := d; r := r * 10 + i.last(a);",
      "INTERFACE I METHOD last : INT VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR END_METHOD END_INTERFACE\n"
      "FUNCTION_BLOCK B VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR VAR_OUTPUT n : DINT; END_VAR\n"
      "n := UPPER_BOUND(a, 1) * 100 + a[2]; a[2] := 9; END_FUNCTION_BLOCK\n"
      "FUNCTION_BLOCK D EXTENDS B IMPLEMENTS I\n"
      "METHOD last : INT VAR k : INT; END_VAR VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR\n"
      "k := UPPER_BOUND(a, 1); last := a[k]; END_METHOD\n"
      "SUPER(); END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("d.n"), "302");
  EXPECT_EQ(program.get("a"), "[1, 9, 3]");
  EXPECT_EQ(program.get("r"), "33");
}

TEST(OpenArrays, StopAtAnIndexOutside) {
  Translated program("VAR p : ARRAY[2..4] OF Point; i : INT := 4; END_VAR", "set_y(p, i, 1);",
                     open_functions);
  EXPECT_EQ(program.scan(), "");
  for (const char* index : {"1", "5"}) {
    program.set("i", index);
    EXPECT_THAT(program.scan(), HasSubstr(std::string("index ") + index + " is outside 2 .. 4 of the array"));
  }
  Translated small("VAR a : ARRAY[0..200] OF INT; END_VAR", "f(a);",
                   "FUNCTION f VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR VAR s : SINT; END_VAR "
                   "s := UPPER_BOUND(a, 1); END_FUNCTION\n");
  EXPECT_THAT(small.scan(), HasSubstr("value 200 is outside -128 .. 127 of the type"));
}

TEST(OpenArrays, AreRefusedWithOneClearLine) {
  const auto first = [](const std::string& declarations, const std::string& statements,
                        const std::string& before = "") {
    const auto lines = compile({{"t.st", open_functions + before + "PROGRAM main VAR " + declarations +
                                             " END_VAR " + statements + " ; END_PROGRAM\n"}},
                               interface_registers())
                           .lines();
    const auto found = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find(": error: ") != std::string::npos;
    });
    return found == lines.end() ? std::string() : *found;
  };
  const auto* where = "ARRAY[*] is for VAR_IN_OUT, where the caller's array gives every limit";
  EXPECT_EQ(first("a : ARRAY[1..2] OF INT;", "total(a);"), "");
  EXPECT_THAT(first("a : ARRAY[*] OF INT;", ""), HasSubstr(where));
  EXPECT_THAT(first("", "", "FUNCTION g VAR_IN_OUT a : ARRAY[*, 1..2] OF INT; END_VAR END_FUNCTION "),
              HasSubstr(where));
  EXPECT_THAT(
      first("", "", "FUNCTION g VAR_IN_OUT a : ARRAY[1..2] OF ARRAY[*] OF INT; END_VAR END_FUNCTION "),
      HasSubstr(where));
  EXPECT_THAT(first("a : ARRAY[1..2] OF DINT;", "total(a);"),
              HasSubstr("VAR_IN_OUT 'a' is ARRAY[*] OF INT, not ARRAY[1..2] OF DINT"));
  EXPECT_THAT(first("a : ARRAY[1..2, 1..2] OF INT;", "total(a);"),
              HasSubstr("VAR_IN_OUT 'a' is ARRAY[*] OF INT"));
  EXPECT_THAT(first("a : ARRAY[1..2] OF INT; i : INT;", "i := UPPER_BOUND(a, 2);"),
              HasSubstr("the array has the dimensions 1 .. 1, not 2"));
  EXPECT_THAT(first("i : INT;", "i := UPPER_BOUND(i, 1);"), HasSubstr("INT is no array"));
  EXPECT_THAT(
      first("", "",
            "FUNCTION g VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR VAR b : ARRAY[0..0] OF INT; END_VAR b := a; "
            "END_FUNCTION "),
      HasSubstr("ARRAY[*] is used by its elements, or passed on as VAR_IN_OUT"));
}

}  // namespace
}  // namespace trunnion::st
