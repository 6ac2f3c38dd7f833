// SPDX-License-Identifier: Apache-2.0
// REF_TO, REF, ^, NULL and ?=.
#include <gmock/gmock.h>

#include <algorithm>

#include "plc/machine/verify.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

using testing::HasSubstr;

constexpr const char* referred =
    "TYPE Point : STRUCT x, y : INT; next : REF_TO INT; END_STRUCT; END_TYPE\n"
    "VAR_GLOBAL g, h : INT := 5; END_VAR\n"
    "FUNCTION bump VAR_INPUT p : REF_TO INT; END_VAR\n"
    "IF p <> NULL AND p^ < 100 THEN p^ := p^ + 1; END_IF; END_FUNCTION\n"
    "FUNCTION pick : REF_TO INT VAR_INPUT first : BOOL; END_VAR\n"
    "IF first THEN pick := REF(g); ELSE pick := REF(h); END_IF; END_FUNCTION\n"
    "FUNCTION_BLOCK Watch VAR_INPUT p : REF_TO INT; END_VAR VAR_OUTPUT q : INT; own : REF_TO INT; END_VAR\n"
    "VAR n : INT := 40; END_VAR\n"
    "METHOD start own := REF(n); END_METHOD\n"
    "q := p^; END_FUNCTION_BLOCK\n";

TEST(References, NameVariables) {
  Translated program(
      "VAR x, y, i : INT := 1; p, q : REF_TO INT; pt : Point; r : REF_TO Point; a : ARRAY[0..2] OF INT;\n"
      "pa : REF_TO ARRAY[0..2] OF INT; t : TON; rt : REF_TO TON; done, same : BOOL; s : STRING := 'a';\n"
      "rs : REF_TO STRING; list : ARRAY[0..1] OF REF_TO INT; END_VAR",
      "p := REF(x); p^ := 3; q := p; q^ := q^ + 1; y := p^; same := p = q;\n"
      "r := REF(pt); r^.y := 7; r^.next := REF(y); r^.next^ := r^.next^ * 10; pa := REF(a); pa^[i] := 9;\n"
      "q := REF(a[i + 1]); q^ := 8; rt := REF(t); rt^(IN := TRUE, PT := T#0s); done := rt^.Q;\n"
      "rs := REF(s); rs^ := CONCAT(rs^, 'b'); list[0] := REF(pt.x); list[0]^ := 6;",
      referred);
  EXPECT_EQ(verify(*program.compilation.code), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("x") + " " + program.get("y") + " " + program.get("same"), "4 40 TRUE");
  EXPECT_EQ(program.get("pt.y") + " " + program.get("pt.x"), "7 6");
  EXPECT_EQ(program.get("a"), "[0, 9, 8]");
  EXPECT_EQ(program.get("done") + program.get("s"), "TRUE'ab'");
  EXPECT_EQ(program.get("list[1]"), "NULL");
  EXPECT_THAT(program.get("p"), HasSubstr("the variable at cell "));
}

TEST(References, AreParametersAndResults) {
  Translated program(
      "VAR x : INT := 99; w : Watch; n : INT; END_VAR VAR_EXTERNAL g, h : INT; END_VAR",
      "bump(REF(x)); bump(REF(x)); bump(NULL); bump(REF(g)); pick(FALSE)^ := 50; w(p := pick(TRUE));\n"
      "w.start(); w.own^ := w.own^ + 2; n := w.own^;",
      referred);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("x"), "100");
  EXPECT_EQ(program.get("g") + " " + program.get("h"), "6 50");
  EXPECT_EQ(program.get("w.q"), "6");
  EXPECT_EQ(program.get("n") + " " + program.get("w.n"), "42 42");
}

// Lists: an element names the next one of its own type.
TEST(References, AreInTheTypeThatTheyName) {
  Translated program(
      "VAR items : ARRAY[1..3] OF Item; it : REF_TO Item; sum, i : INT; a, b : Node; END_VAR",
      "FOR i := 1 TO 2 DO items[i].next := REF(items[i + 1]); END_FOR;\n"
      "FOR i := 1 TO 3 DO items[i].value := 10 * i; END_FOR;\n"
      "it := REF(items[1]); WHILE it <> NULL DO sum := sum + it^.value; it := it^.next; END_WHILE;\n"
      "sum := sum + items[1].next^.next^.value; a.value := 1; a.next := REF(b); b.value := 2; a();",
      "TYPE Item : STRUCT value : INT; next : REF_TO Item; END_STRUCT; END_TYPE\n"
      "FUNCTION_BLOCK Node VAR_INPUT value : INT; next : REF_TO Node; END_VAR VAR_OUTPUT sum : INT; END_VAR\n"
      "sum := value + next^.value; END_FUNCTION_BLOCK\n");
  EXPECT_EQ(verify(*program.compilation.code), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("sum"), "90");  // 10 + 20 + 30, and once more the last one
  EXPECT_EQ(program.get("a.sum"), "3");
}

// As at an index outside an array the PLC stops and names the place.
TEST(References, StopAtNull) {
  for (const char* use : {"p^ := 1;", "i := p^;", "r^.y := 1;", "pa^[i] := 1;", "rs^ := 'a';",
                          "rt^(IN := TRUE);", "rs2 := rs^;", "pt := r^;"}) {
    Translated program(
        "VAR p : REF_TO INT; r : REF_TO Point; pa : REF_TO ARRAY[0..9] OF INT; rs : REF_TO STRING;\n"
        "rt : REF_TO TON; rs2 : STRING; pt : Point; i : INT; END_VAR",
        use, referred);
    const auto fault = program.scan();
    EXPECT_THAT(fault, HasSubstr("t.st:14:")) << use;
    EXPECT_THAT(fault, HasSubstr("a reference to no variable")) << use;
  }
}

TEST(References, AreRefusedWithOneClearLine) {
  const auto first = [](const std::string& statements, const std::string& before = "") {
    const auto lines =
        compile({{"t.st", referred + before +
                              "PROGRAM main VAR p : REF_TO INT; q : REF_TO DINT; x : INT; t : TON; lamp AT "
                              "%Y0.1 : BOOL; pb : REF_TO BOOL; END_VAR " +
                              statements + " ; END_PROGRAM\n"}},
                interface_registers())
            .lines();
    const auto found = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find(": error: ") != std::string::npos;
    });
    return found == lines.end() ? std::string() : *found;
  };
  EXPECT_EQ(first("p := REF(x);"), "");
  EXPECT_THAT(first("q := REF(x);"), HasSubstr("expected REF_TO DINT, found REF_TO INT"));
  EXPECT_THAT(first("p := x;"), HasSubstr("expected REF_TO INT, found INT"));
  EXPECT_THAT(first("x := p;"), HasSubstr("expected INT, found REF_TO INT"));
  EXPECT_THAT(first("x := x^;"), HasSubstr("INT is no reference, so it has no '^'"));
  EXPECT_THAT(first("p := REF(5);"), HasSubstr("a variable is required"));
  EXPECT_THAT(first("pb := REF(t.Q);"), HasSubstr("is set by the block alone and cannot be written"));
  EXPECT_THAT(first("pb := REF(lamp);"), HasSubstr("a register has no reference"));
  EXPECT_THAT(first("pb := REF(%X0.1);"), HasSubstr("a register has no reference"));
  EXPECT_THAT(first("IF p < p THEN ; END_IF;"), HasSubstr("references are compared by = and <> only"));
  EXPECT_THAT(first("", "VAR_GLOBAL RETAIN k : REF_TO INT; END_VAR "), HasSubstr("RETAIN is not permitted"));
  EXPECT_THAT(first("", "FUNCTION_BLOCK B VAR next : REF_TO B; END_VAR next^(); END_FUNCTION_BLOCK "),
              HasSubstr("'B' calls or contains itself"));
  EXPECT_THAT(first("", "TYPE S : STRUCT s : S; r : REF_TO S; END_STRUCT; END_TYPE "),
              HasSubstr("the type 'S' contains itself"));
  EXPECT_THAT(first("", "TYPE P : REF_TO Q; Q : REF_TO ARRAY[0..1] OF P; END_TYPE "),
              HasSubstr("contains itself"));
  // Of the variables of Owner those behind `part` are not known when the body of Part is translated.
  EXPECT_THAT(first("",
                    "FUNCTION_BLOCK Owner VAR part : Part; n : INT; END_VAR METHOD m n := 1; END_METHOD "
                    "part(owner := REF(THIS)); END_FUNCTION_BLOCK "
                    "FUNCTION_BLOCK Part VAR_INPUT owner : REF_TO Owner; END_VAR owner^.m(); "
                    "END_FUNCTION_BLOCK "),
              HasSubstr("'Owner' contains 'Part', which therefore cannot call its method 'm'"));
  const auto* gone = "may be gone when the reference is used";
  EXPECT_THAT(first("", "FUNCTION f : REF_TO INT VAR i : INT; END_VAR f := REF(i); END_FUNCTION "),
              HasSubstr(gone));
  EXPECT_THAT(first("", "FUNCTION f : REF_TO INT VAR_IN_OUT i : INT; END_VAR f := REF(i); END_FUNCTION "),
              HasSubstr(gone));
  EXPECT_THAT(first("",
                    "FUNCTION_BLOCK B VAR_TEMP i : INT; END_VAR VAR p : REF_TO INT; END_VAR p := REF(i); "
                    "END_FUNCTION_BLOCK "),
              HasSubstr(gone));
  EXPECT_THAT(first("",
                    "FUNCTION_BLOCK B VAR p : REF_TO INT; END_VAR METHOD m VAR i : INT; END_VAR p := REF(i); "
                    "END_METHOD END_FUNCTION_BLOCK "),
              HasSubstr(gone));
}

TEST(References, BeginWithTheirInitialValuesInNewPrograms) {
  const auto translated = [](const std::string& more) {
    return compile({{"t.st", "PROGRAM main VAR " + more +
                                 " x : INT; p : REF_TO INT; END_VAR p := REF(x); END_PROGRAM\n"}},
                   interface_registers());
  };
  const auto running = translated(""), next = translated("before : INT;");
  ASSERT_TRUE(running.good() && next.good());
  const Changeover change{Variables(running), Variables(next)};
  EXPECT_THAT(change.losses(),
              testing::Contains("main.p (REF_TO INT) names a variable by its place: it begins with "
                                "its initial value"));
  ASSERT_EQ(change.moves().size(), 1u);
  EXPECT_EQ(change.moves()[0].path, "main.x");
}

}  // namespace
}  // namespace trunnion::st
