// SPDX-License-Identifier: Apache-2.0
// NAMESPACE, USING and INTERNAL (IEC 61131-3:2013, 6.9).
#include <gmock/gmock.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plc/tools/uses.hpp"
#include "plc/tools/variables.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

std::string first_error_of_sources(const std::vector<Source>& sources) {
  for (const auto& line : compile(sources, interface_registers()).lines())
    if (line.find(": error: ") != std::string::npos) return line;
  return "";
}

std::string first_error(const std::string& text) {
  return first_error_of_sources(std::vector<Source>{Source{"t.st", text}});
}

constexpr const char* drives =
    "NAMESPACE drives\n"
    "TYPE Mode : (idle, moving); Limits : STRUCT low, high : INT; END_STRUCT; END_TYPE\n"
    "VAR_GLOBAL CONSTANT most : INT := 4; END_VAR VAR_GLOBAL total : INT := 1; END_VAR\n"
    "FUNCTION twice : INT VAR_INPUT v : INT; END_VAR twice := v * 2; END_FUNCTION\n"
    "FUNCTION_BLOCK Motor VAR_OUTPUT n : INT; mode : Mode; END_VAR\n"
    "METHOD PUBLIC up : INT n := twice(n) + most; mode := moving; up := n; END_METHOD\n"
    "END_FUNCTION_BLOCK\n"
    "NAMESPACE linear\n"
    "FUNCTION half : INT VAR_INPUT v : INT; END_VAR half := v / 2; END_FUNCTION\n"
    "END_NAMESPACE;\n"
    "END_NAMESPACE\n";

// up() = 0 * 2 + 4; half(twice(4)) = 8 / 2; total = 1 + 1.
TEST(Namespaces, HaveUnitsTypesAndVariablesByTheirWholeName) {
  Translated program(
      "VAR m : drives.Motor; l : Drives.limits; a : ARRAY[1..drives.most] OF INT;\n"
      "c : drives.Mode := drives.Mode#moving; i, j, k : INT; b : BOOL; END_VAR",
      "i := m.up(); j := drives.linear.half(drives.twice(v := drives.most));\n"
      "drives.total := drives.total + 1; a[drives.most] := 9; l.high := a[4];\n"
      "b := m.mode = drives.moving AND c = DRIVES.Mode.moving;\n"
      "CASE c OF drives.idle: k := 1; drives.Mode#moving: k := 2; END_CASE;",
      drives);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("i"), "4");
  EXPECT_EQ(program.get("j"), "4");
  EXPECT_EQ(program.get("drives.total"), "2");
  EXPECT_EQ(program.get("l.high"), "9");
  EXPECT_EQ(program.get("b"), "TRUE");
  EXPECT_EQ(program.get("k"), "2");
  EXPECT_THROW(program.get("drives.most"), std::runtime_error) << "it is a constant";
}

// Both pieces are a.b, whose other names need no namespace: 1 + 2 = 3. The USING of one source is not that of
// another.
TEST(Namespaces, HaveSeveralPiecesInSeveralSources) {
  const std::vector<Source> sources{
      {"a.st", "NAMESPACE a.b FUNCTION f : INT f := 1; END_FUNCTION END_NAMESPACE\n"},
      {"b.st",
       "USING a;\nNAMESPACE a NAMESPACE b FUNCTION g : INT g := f() + 2; END_FUNCTION\n"
       "END_NAMESPACE FUNCTION h : INT h := b.g(); END_FUNCTION END_NAMESPACE\n"},
      {"m.st", "PROGRAM main VAR i : INT; END_VAR i := A.h(); END_PROGRAM\n"}};
  const auto compilation = compile(sources, interface_registers());
  ASSERT_TRUE(compilation.good()) << testing::PrintToString(compilation.lines());
  SourceRun run(compilation);
  EXPECT_EQ(run.scan("").kind, FaultKind::none);
  EXPECT_EQ(run.get("i"), "3");
  auto other = sources;
  other[2].text = "PROGRAM main VAR i : INT; END_VAR i := h(); END_PROGRAM\n";
  EXPECT_EQ(first_error_of_sources(other), "m.st:1:40: error: there is no function 'h'");
}

TEST(Namespaces, TheInnerNameComesFirst) {
  Translated program("VAR i, j, k, l : INT; END_VAR", "i := f(); j := a.f(); k := a.b.q(); l := a.c.q();",
                     "FUNCTION f : INT f := 1; END_FUNCTION\n"
                     "NAMESPACE a FUNCTION f : INT f := 2; END_FUNCTION\n"
                     "NAMESPACE b FUNCTION q : INT q := f(); END_FUNCTION END_NAMESPACE\n"
                     "NAMESPACE c FUNCTION f : INT f := 3; END_FUNCTION\n"
                     "FUNCTION q : INT q := f(); END_FUNCTION END_NAMESPACE\n"
                     "END_NAMESPACE\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("i"), "1");
  EXPECT_EQ(program.get("j"), "2");
  EXPECT_EQ(program.get("k"), "2") << "a.f is around a.b, before the global f";
  EXPECT_EQ(program.get("l"), "3");
}

// own(): v of y itself and w of x, 20 + 11. in_unit(): z has no v, so USING y of the function comes before
// USING x of the namespace. The standard function LIMIT is global and comes before USING of the source.
TEST(Namespaces, TheOwnNamespaceComesBeforeUsing) {
  Translated program(
      "VAR i, j, k, l, m : INT; END_VAR",
      "i := y.own(); j := s(); k := w(); l := z.in_unit(); m := LIMIT(0, 3, 9);",
      "USING x;\n"
      "NAMESPACE x FUNCTION v : INT v := 10; END_FUNCTION FUNCTION w : INT w := 11; END_FUNCTION\n"
      "FUNCTION LIMIT : INT LIMIT := 5; END_FUNCTION END_NAMESPACE\n"
      "NAMESPACE y USING x; FUNCTION v : INT v := 20; END_FUNCTION\n"
      "FUNCTION own : INT own := v() + w(); END_FUNCTION END_NAMESPACE\n"
      "NAMESPACE z USING x; FUNCTION in_unit : INT USING y; in_unit := v(); END_FUNCTION\n"
      "END_NAMESPACE\n"
      "FUNCTION s : INT USING x, z; s := v() + x.LIMIT(); END_FUNCTION\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("i"), "31");
  EXPECT_EQ(program.get("j"), "15");
  EXPECT_EQ(program.get("k"), "11");
  EXPECT_EQ(program.get("l"), "20");
  EXPECT_EQ(program.get("m"), "3");
}

TEST(Namespaces, AnAmbiguousNameNamesBothPlaces) {
  std::vector<Source> sources{
      {"a.st", "NAMESPACE a FUNCTION f : INT f := 1; END_FUNCTION END_NAMESPACE\n"},
      {"b.st", "\nNAMESPACE b FUNCTION f : INT f := 1; END_FUNCTION END_NAMESPACE\n"},
      {"m.st", "USING a, b;\nPROGRAM main VAR i : INT; END_VAR i := f(); END_PROGRAM\n"}};
  EXPECT_EQ(
      first_error_of_sources(sources),
      "m.st:2:40: error: 'f' is ambiguous: 'a.f' (a.st:1:22) and 'b.f' (b.st:2:22); write the namespace "
      "before it");
  sources[2].text = "USING a, b, a;\nPROGRAM main VAR i : INT; END_VAR i := b.f(); END_PROGRAM\n";
  EXPECT_EQ(first_error_of_sources(sources), "");
  sources[2].text = "USING a, a;\nPROGRAM main VAR i : INT; END_VAR i := f(); END_PROGRAM\n";
  EXPECT_EQ(first_error_of_sources(sources), "") << "the same one twice";
}

// A USING brings what the namespace has, and not the namespaces in it.
TEST(Namespaces, UsingNamesANamespaceFromTheInsideToTheOutside) {
  const std::string before =
      "NAMESPACE a.b FUNCTION f : INT f := 1; END_FUNCTION END_NAMESPACE\n"
      "NAMESPACE a FUNCTION g : INT USING b; g := f(); END_FUNCTION END_NAMESPACE\n";
  EXPECT_EQ(first_error(before + "USING a.b; PROGRAM main VAR i : INT; END_VAR i := f(); END_PROGRAM\n"), "");
  EXPECT_EQ(first_error(before + "USING b; PROGRAM main ; END_PROGRAM\n"),
            "t.st:3:7: error: there is no namespace 'b'");
  EXPECT_EQ(first_error(before + "USING a; PROGRAM main VAR i : INT; END_VAR i := b.f(); END_PROGRAM\n"),
            "t.st:3:49: error: there is no variable 'b'");
}

// q = 4 * 100 + 6 * 10 + 6: g() = 3 + 1, up() and then v are 6.
TEST(Namespaces, InternalIsVisibleInItsNamespaceAndThoseInIt) {
  Translated program("VAR d : a.D; END_VAR", "d();",
                     "NAMESPACE a\n"
                     "FUNCTION INTERNAL f : INT f := 3; END_FUNCTION\n"
                     "NAMESPACE INTERNAL b FUNCTION g : INT g := f() + 1; END_FUNCTION END_NAMESPACE\n"
                     "VAR_GLOBAL INTERNAL CONSTANT ten : INT := 10; END_VAR\n"
                     "TYPE INTERNAL T : INT; END_TYPE\n"
                     "FUNCTION_BLOCK INTERNAL C VAR INTERNAL v : T := 5; END_VAR\n"
                     "METHOD INTERNAL up : INT v := v + 1; up := v; END_METHOD END_FUNCTION_BLOCK\n"
                     "FUNCTION_BLOCK D VAR_OUTPUT q : INT; END_VAR VAR c : C; END_VAR\n"
                     "q := b.g() * 100 + c.up() * ten; q := q + c.v; END_FUNCTION_BLOCK\n"
                     "END_NAMESPACE\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("d.q"), "466");
}

TEST(Namespaces, InternalIsAnErrorElsewhere) {
  const std::string start = "PROGRAM main VAR i : INT; END_VAR i := ";
  const auto internal = [](const std::string& element, const std::string& space) {
    return ": error: '" + element + "' is INTERNAL and visible in the namespace '" + space + "' only";
  };
  const std::string function = "NAMESPACE a FUNCTION INTERNAL f : INT f := 1; END_FUNCTION END_NAMESPACE\n";
  EXPECT_EQ(first_error(function + start + "a.f(); END_PROGRAM\n"), "t.st:2:40" + internal("a.f", "a"));
  EXPECT_EQ(first_error(function + "USING a; " + start + "f(); END_PROGRAM\n"),
            "t.st:2:49" + internal("a.f", "a"));
  EXPECT_EQ(first_error(function + "FUNCTION f : INT f := 1; END_FUNCTION USING a;\n" + start +
                        "f(); END_PROGRAM\n"),
            "");
  const std::string inner =
      "NAMESPACE a NAMESPACE INTERNAL b FUNCTION f : INT f := 1; END_FUNCTION END_NAMESPACE END_NAMESPACE\n";
  EXPECT_EQ(first_error(inner + start + "a.b.f(); END_PROGRAM\n"), "t.st:2:40" + internal("a.b", "a"));
  EXPECT_EQ(first_error(inner + "USING a.b;\n"), "t.st:2:7" + internal("a.b", "a"));
  EXPECT_EQ(first_error("NAMESPACE INTERNAL a FUNCTION f : INT f := 1; END_FUNCTION END_NAMESPACE\n" + start +
                        "a.f(); END_PROGRAM\n"),
            "t.st:2:40" + internal("a", "a"));
  EXPECT_EQ(first_error("NAMESPACE a TYPE INTERNAL T : INT; END_TYPE END_NAMESPACE\n"
                        "PROGRAM main VAR i : a.T; END_VAR ; END_PROGRAM\n"),
            "t.st:2:22" + internal("a.T", "a"));
  const std::string block =
      "NAMESPACE a FUNCTION_BLOCK B VAR INTERNAL v : INT; END_VAR METHOD INTERNAL up v := v + 1; END_METHOD\n"
      "END_FUNCTION_BLOCK END_NAMESPACE\n";
  EXPECT_EQ(first_error(block + "PROGRAM main VAR b : a.B; i : INT; END_VAR i := b.v; END_PROGRAM\n"),
            "t.st:3:51" + internal("v' of 'a.B", "a"));
  EXPECT_EQ(first_error(block + "PROGRAM main VAR b : a.B; END_VAR b.up(); END_PROGRAM\n"),
            "t.st:3:37" + internal("up' of 'a.B", "a"));
  EXPECT_EQ(first_error(block + "FUNCTION_BLOCK D EXTENDS a.B up(); END_FUNCTION_BLOCK\n"),
            "t.st:3:30" + internal("up' of 'a.B", "a"));
  EXPECT_EQ(first_error(block + "FUNCTION_BLOCK D EXTENDS a.B v := 1; END_FUNCTION_BLOCK\n"),
            "t.st:3:30" + internal("v' of 'a.B", "a"));
}

TEST(Namespaces, ErrorsHaveTheirPlace) {
  const std::string a = "NAMESPACE a TYPE T : INT; END_TYPE END_NAMESPACE\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"USING q;\nPROGRAM main ; END_PROGRAM\n", "t.st:1:7: error: there is no namespace 'q'"},
      {"PROGRAM main USING q.r; ; END_PROGRAM\n", "t.st:1:20: error: there is no namespace 'q.r'"},
      {a + "PROGRAM main a.f(); END_PROGRAM\n", "t.st:2:14: error: the namespace 'a' has no 'f'"},
      {a + "PROGRAM main VAR i : a.U; END_VAR ; END_PROGRAM\n",
       "t.st:2:22: error: the namespace 'a' has no 'U'"},
      {a + "PROGRAM main VAR i : a.T.x; END_VAR ; END_PROGRAM\n",
       "t.st:2:22: error: there is no type or unit 'a.T.x'"},
      {a + "PROGRAM main VAR i : INT; END_VAR i := a; END_PROGRAM\n",
       "t.st:2:40: error: 'a' is a namespace: name what you mean of it, a.name"},
      {"NAMESPACE a END_NAMESPACE FUNCTION a : INT a := 1; END_FUNCTION\n",
       "t.st:1:11: error: 'a' is no namespace, as it is declared at t.st:1:36"},
      {"NAMESPACE abs END_NAMESPACE\n",
       "t.st:1:11: error: 'abs' is a name of the standard or of a register and cannot be that of a "
       "namespace"},
      {"NAMESPACE a TYPE INT : DINT; END_TYPE END_NAMESPACE\n",
       "t.st:1:18: error: 'INT' is a type of the standard"},
      {"NAMESPACE a FUNCTION f : INT f := 1; END_FUNCTION FUNCTION f : INT f := 2; END_FUNCTION "
       "END_NAMESPACE\n",
       "t.st:1:60: error: 'a.f' is declared already in line 1"},
      {"NAMESPACE a FUNCTION f : INT VAR f : INT; END_VAR f := 1; END_FUNCTION END_NAMESPACE\n",
       "t.st:1:22: error: 'f' is the result of the function: give the variable another name"},
      {"NAMESPACE a\n", "t.st:1:11: error: the namespace 'a' has no END_NAMESPACE"},
      {"END_NAMESPACE\n", "t.st:1:1: error: there is no NAMESPACE that END_NAMESPACE ends"},
      {"NAMESPACE a x END_NAMESPACE\n",
       "t.st:1:13: error: expected PROGRAM, FUNCTION, FUNCTION_BLOCK, TEST, TYPE, VAR_GLOBAL or "
       "END_NAMESPACE, found 'x'"},
      {"NAMESPACE a CONFIGURATION c END_CONFIGURATION END_NAMESPACE\n",
       "t.st:1:13: error: a CONFIGURATION is in no namespace: write it behind END_NAMESPACE"},
      {"NAMESPACE a FUNCTION f : INT f := 1; END_NAMESPACE\n",
       "t.st:1:38: error: expected END_FUNCTION at the end of a function, found 'END_NAMESPACE'"}};
  for (const auto& [text, line] : cases) EXPECT_EQ(first_error(text), line) << text;
}

TEST(Namespaces, NestTwoHundredLevelsAtMost) {
  const auto nested = [](int levels, int ends) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += "NAMESPACE a ";
    for (int i = 0; i < ends; ++i) text += "END_NAMESPACE ";
    return first_error(text);
  };
  EXPECT_EQ(nested(200, 200), "");
  EXPECT_THAT(nested(201, 200), testing::HasSubstr("less nesting (at most 200 levels)"));
}

TEST(Namespaces, HaveInterfacesClassesAndBlocksThatAreExtended) {
  Translated program("VAR p : Pump; d : a.Device; b : BOOL; r : INT; END_VAR",
                     "d := p; b := d.start(); r := p.speed;",
                     "NAMESPACE a INTERFACE Device METHOD start : BOOL END_METHOD END_INTERFACE\n"
                     "FUNCTION_BLOCK Base VAR_OUTPUT speed : INT; END_VAR END_FUNCTION_BLOCK END_NAMESPACE\n"
                     "FUNCTION_BLOCK Pump USING a; EXTENDS Base IMPLEMENTS Device\n"
                     "METHOD PUBLIC start : BOOL speed := 7; start := TRUE; END_METHOD END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("b"), "TRUE");
  EXPECT_EQ(program.get("r"), "7");
}

// Where the type is known its values need no namespace. number(moving) is 1, and the input is a local name.
TEST(Namespaces, HaveEnumeratedValues) {
  Translated program(
      "VAR x : a.Mode; y : b.Mode; p, q : BOOL; i : INT; END_VAR",
      "x := moving; y := moving; p := x = a.Mode#moving; q := y = b.moving AND b.moving = b.Mode#moving;\n"
      "i := a.number(x) * 10 + b.number(y);",
      "NAMESPACE a TYPE Mode : (idle, moving); END_TYPE\n"
      "FUNCTION number : INT VAR_INPUT m : Mode; END_VAR number := Mode_TO_INT(m); END_FUNCTION\n"
      "END_NAMESPACE\n"
      "NAMESPACE b TYPE Mode : (moving, idle); END_TYPE\n"
      "FUNCTION number : INT VAR_INPUT m : Mode; END_VAR\n"
      "CASE m OF moving: number := 5; idle: number := 6; END_CASE; END_FUNCTION\n"
      "END_NAMESPACE\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("p"), "TRUE");
  EXPECT_EQ(program.get("q"), "TRUE");
  EXPECT_EQ(program.get("i"), "15");
}

// A variable a hides the namespace a. Edges are detected by R_TRIG of the standard, one in two scans.
TEST(Namespaces, LocalNamesComeFirst) {
  Translated program("VAR a : n.Pair; e : n.E; END_VAR", "a.f := 3; e(s := TRUE);",
                     "NAMESPACE a FUNCTION f : INT f := 1; END_FUNCTION END_NAMESPACE\n"
                     "NAMESPACE n TYPE Pair : STRUCT f : INT; END_STRUCT; END_TYPE\n"
                     "FUNCTION_BLOCK R_TRIG END_FUNCTION_BLOCK\n"
                     "FUNCTION_BLOCK E VAR_INPUT s : BOOL R_EDGE; END_VAR VAR_OUTPUT n : INT; END_VAR\n"
                     "VAR u : (up, down); END_VAR\n"
                     "IF s THEN n := n + 1; u := down; END_IF; END_FUNCTION_BLOCK\n"
                     "END_NAMESPACE\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("main.a.f"), "3");
  EXPECT_EQ(program.get("e.n"), "1");
}

constexpr const char* counter_of_a_namespace =
    "NAMESPACE a\n"                                                              // 1
    "VAR_GLOBAL g : INT; END_VAR\n"                                              // 2
    "PROGRAM count VAR n : INT; END_VAR\n"                                       // 3
    "VAR_EXTERNAL g : INT; END_VAR\n"                                            // 4
    "n := n + 1; g := n;\n"                                                      // 5
    "END_PROGRAM\n"                                                              // 6
    "FUNCTION_BLOCK B VAR_INPUT v : INT; END_VAR VAR_OUTPUT w : INT; END_VAR\n"  // 7
    "w := v;\n"                                                                  // 8
    "END_FUNCTION_BLOCK\n"                                                       // 9
    "END_NAMESPACE\n";                                                           // 10

std::string places_of(const Uses& uses, const std::string& path) {
  std::string text;
  for (const auto& [file, use] : uses.of(path))
    text += (text.empty() ? "" : " ") + std::to_string(use.at.line) + ":" + std::to_string(use.at.column) +
            (use.reads ? "r" : "") + (use.writes ? "w" : "");
  return text;
}

TEST(Namespaces, PathsAndUsesHaveTheWholeName) {
  const auto compilation = compile({{"t.st", counter_of_a_namespace}}, interface_registers());
  ASSERT_TRUE(compilation.good()) << testing::PrintToString(compilation.lines());
  const Variables variables(compilation);
  EXPECT_EQ(variables.find("A.COUNT.N").path, "a.count.n");
  EXPECT_EQ(variables.find("n").path, "a.count.n") << "one program alone has it";
  EXPECT_EQ(variables.find("a.g").path, "a.g");
  const Uses uses(compilation);
  EXPECT_EQ(places_of(uses, "a.count.n"), "5:1w 5:6r 5:18r");
  EXPECT_EQ(places_of(uses, "a.g"), "5:13w");
  EXPECT_EQ(places_of(uses, "a.B.v"), "8:6r");
}

TEST(Namespaces, ConfigurationsAndTestsNameTheirPrograms) {
  Translated program(std::string(counter_of_a_namespace) +
                         "CONFIGURATION c TASK t(INTERVAL := T#10ms);\n"
                         "PROGRAM p WITH t : a.count; END_CONFIGURATION\n",
                     0);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("p.n"), "1");
  EXPECT_EQ(program.get("a.g"), "1");
  EXPECT_EQ(places_of(Uses(program.compilation), "p.n"), "5:1w 5:6r 5:18r");
  const auto tested = compile({{"t.st", std::string(counter_of_a_namespace) +
                                            "TEST 'it counts' a.count(); a.count();\n"
                                            "ASSERT_EQ(a.count.n, 2); ASSERT_EQ(a.g, 2); END_TEST\n"}},
                              interface_registers());
  ASSERT_TRUE(tested.good()) << testing::PrintToString(tested.lines());
  const auto results = run_tests(tested);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_TRUE(results[0].passed) << results[0].message;
}

TEST(Namespaces, ProgramsWithoutThemKeepTheirLayout) {
  const Source plain{"main.st",
                     "TYPE Mode : (idle, moving); END_TYPE VAR_GLOBAL RETAIN hours : UDINT; END_VAR\n"
                     "PROGRAM main VAR m : Mode; t : TON; END_VAR VAR RETAIN n : INT; END_VAR\n"
                     "t(IN := m = moving, PT := T#1s); n := n + 1; hours := hours + 1; END_PROGRAM\n"};
  const auto alone = compile({plain}, interface_registers());
  const auto beside = compile({plain, {"n.st", "NAMESPACE n TYPE Mode : (moving); END_TYPE END_NAMESPACE\n"}},
                              interface_registers());
  ASSERT_TRUE(alone.good());
  ASSERT_TRUE(beside.good()) << testing::PrintToString(beside.lines());
  EXPECT_EQ(alone.layout(), beside.layout());
  EXPECT_EQ(alone.code->code.size(), beside.code->code.size());
}

}  // namespace
}  // namespace trunnion::st
