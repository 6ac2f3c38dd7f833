// SPDX-License-Identifier: Apache-2.0
// Function blocks and classes that extend others.
#include <gmock/gmock.h>

#include "plc/machine/verify.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

std::vector<std::string> inheritance_lines(const std::string& text) {
  return compile({{"t.st", text}}, interface_registers()).lines();
}

constexpr const char* base_block =
    "FUNCTION_BLOCK Base\n"
    "VAR_INPUT x : INT; END_VAR VAR_OUTPUT y : INT; END_VAR VAR k : INT := 2; END_VAR\n"
    "VAR_TEMP t : INT; END_VAR\n"
    "METHOD scaled : INT scaled := x * k; END_METHOD\n"
    "METHOD FINAL next : INT next := scaled() + offset(); END_METHOD\n"
    "METHOD PRIVATE offset : INT offset := 1; END_METHOD\n"
    "t := t + 1; IF x < 0 THEN RETURN; END_IF; y := next() + t;\n"
    "END_FUNCTION_BLOCK\n";

// Base: y = 3 * 2 + 1 + 1. Derived: scaled() is 60 in next() of Base too, so y = 60 + 1 + 1 and z = y + k; t
// begins with 0 in both executions of the body, and the private offset() of Derived is another one.
TEST(Inheritance, TakesVariablesMethodsAndTheBody) {
  Translated program("VAR b : Base; d, e : Derived; u : INT; END_VAR",
                     "b(x := 3); d(x := 3); u := d.next(); e(x := -1);",
                     std::string(base_block) +
                         "FUNCTION_BLOCK Derived EXTENDS Base VAR_OUTPUT z : INT; END_VAR\n"
                         "METHOD OVERRIDE scaled : INT scaled := SUPER.scaled() * 10; END_METHOD\n"
                         "METHOD PRIVATE offset : INT offset := 1000; END_METHOD\n"
                         "SUPER(); SUPER^(); z := y + k; k := k + offset();\n"
                         "END_FUNCTION_BLOCK\n");
  EXPECT_EQ(verify(*program.compilation.code), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("b.y"), "8");
  EXPECT_EQ(program.get("d.y"), "62");
  EXPECT_EQ(program.get("d.z"), "64");
  EXPECT_EQ(program.get("d.k"), "1002");
  EXPECT_EQ(program.get("u"), "30061");  // 3 * 1002 * 10 + 1
  EXPECT_EQ(program.get("e.z"), "2");    // RETURN leaves the body of Base, not that of Derived
}

// The code of Base means the global `limit` and the function raised() also in an instance of Derived, which
// has both names for its own: 3 + 1 = 4, and 40. In Derived they are its own: 5 + 100 = 105.
TEST(Inheritance, LeavesTheNamesInTheExtendedBlockWhatTheyAre) {
  Translated program("VAR d : Derived; m : INT; END_VAR", "d(); m := d.read();",
                     "VAR_GLOBAL limit : INT := 3; END_VAR\n"
                     "FUNCTION raised : INT VAR_INPUT v : INT; END_VAR raised := v + 1; END_FUNCTION\n"
                     "FUNCTION_BLOCK Base VAR_OUTPUT y : INT; END_VAR\n"
                     "METHOD read : INT read := raised(limit); END_METHOD\n"
                     "y := raised(limit) * 10; END_FUNCTION_BLOCK\n"
                     "FUNCTION_BLOCK Derived EXTENDS Base VAR_OUTPUT own : INT; END_VAR\n"
                     "VAR limit : INT := 100; END_VAR\n"
                     "METHOD raised : INT VAR_INPUT v : INT; END_VAR raised := v + limit; END_METHOD\n"
                     "SUPER(); own := raised(5); END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("m"), "4");
  EXPECT_EQ(program.get("d.y"), "40");
  EXPECT_EQ(program.get("d.own"), "105");
}

TEST(Inheritance, GoesOverSeveralBlocksWithSuperAtEach) {
  Translated program(
      "VAR c : C3; r : STRING; END_VAR", "r := c.name();",
      "CLASS C1 METHOD PUBLIC name : STRING name := CONCAT('1', kind()); END_METHOD\n"
      "METHOD PROTECTED kind : STRING kind := 'a'; END_METHOD END_CLASS\n"
      "CLASS C2 EXTENDS C1 METHOD PUBLIC OVERRIDE name : STRING name := CONCAT('2', SUPER.name());\n"
      "END_METHOD END_CLASS\n"
      "CLASS C3 EXTENDS C2 METHOD PUBLIC OVERRIDE name : STRING name := CONCAT('3', SUPER.name());\n"
      "END_METHOD METHOD PROTECTED OVERRIDE kind : STRING kind := 'c'; END_METHOD END_CLASS\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("r"), "'321c'");
}

// The timer of the extended block ends after 20 ms, and the machine knows it.
TEST(Inheritance, ExtendsBlocksOfTheLibrary) {
  Translated program("VAR d : Delay; END_VAR", "d(IN := TRUE, PT := T#20ms);",
                     "FUNCTION_BLOCK Delay EXTENDS TON VAR_OUTPUT early : BOOL; END_VAR\n"
                     "SUPER(); early := NOT Q; END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("d.early"), "TRUE");
  EXPECT_EQ(program.run.machine().next_timer_end(0), 20000000);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("d.early"), "TRUE");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("d.early"), "FALSE");
}

TEST(Inheritance, IsRefusedWithOneClearLine) {
  const auto first = [](const std::string& text) {
    for (const auto& line : inheritance_lines(base_block + text))
      if (line.find(": error: ") != std::string::npos) return line;
    return std::string();
  };
  using testing::HasSubstr;
  EXPECT_EQ(first("FUNCTION_BLOCK D EXTENDS Base END_FUNCTION_BLOCK"), "");
  EXPECT_EQ(first("FUNCTION_BLOCK D EXTENDS Bas END_FUNCTION_BLOCK"),
            "t.st:9:26: error: 'Bas' is no function block and no class");
  EXPECT_THAT(first("FUNCTION_BLOCK D EXTENDS D END_FUNCTION_BLOCK"),
              HasSubstr("'D' calls or contains itself"));
  EXPECT_THAT(
      first("FUNCTION_BLOCK FINAL F END_FUNCTION_BLOCK FUNCTION_BLOCK D EXTENDS F END_FUNCTION_BLOCK"),
      HasSubstr("'F' is FINAL and cannot be extended"));
  EXPECT_THAT(first("CLASS D EXTENDS Base END_CLASS"),
              HasSubstr("'Base' is no class: a class extends a class"));
  EXPECT_THAT(first("FUNCTION_BLOCK D EXTENDS Base METHOD OVERRIDE next : INT next := 1; END_METHOD "
                    "END_FUNCTION_BLOCK"),
              HasSubstr("the method 'next' of 'Base' is FINAL and cannot be overridden"));
  EXPECT_THAT(first("FUNCTION_BLOCK D EXTENDS Base METHOD OVERRIDE other END_METHOD END_FUNCTION_BLOCK"),
              HasSubstr("there is no method 'other' to override"));
  EXPECT_THAT(
      first("FUNCTION_BLOCK D EXTENDS Base METHOD OVERRIDE scaled : DINT END_METHOD END_FUNCTION_BLOCK"),
      HasSubstr("the method 'scaled' has other parameters or another result than that of 'Base'"));
  EXPECT_THAT(first("FUNCTION_BLOCK D EXTENDS Base y := offset(); END_FUNCTION_BLOCK"),
              HasSubstr("the method 'offset' of 'Base' is PRIVATE"));
  EXPECT_THAT(first("FUNCTION_BLOCK D EXTENDS Base VAR k : INT; END_VAR END_FUNCTION_BLOCK"),
              HasSubstr("the variable 'k' is declared already in line 2"));
  EXPECT_THAT(first("FUNCTION_BLOCK ABSTRACT A METHOD ABSTRACT m END_METHOD END_FUNCTION_BLOCK "
                    "FUNCTION_BLOCK D EXTENDS A END_FUNCTION_BLOCK"),
              HasSubstr("'D' has the method 'm', which is ABSTRACT in 'A'"));
  EXPECT_THAT(
      first("FUNCTION_BLOCK ABSTRACT A END_FUNCTION_BLOCK PROGRAM main VAR a : A; END_VAR ; END_PROGRAM"),
      HasSubstr("'A' is ABSTRACT and has no instances"));
  EXPECT_THAT(first("FUNCTION_BLOCK D SUPER(); END_FUNCTION_BLOCK"),
              HasSubstr("'D' extends no function block, so it has no SUPER"));
  EXPECT_THAT(first("CLASS C VAR PRIVATE p : INT; END_VAR END_CLASS "
                    "CLASS D EXTENDS C METHOD m p := 1; END_METHOD END_CLASS"),
              HasSubstr("'p' is PRIVATE in 'C'"));
  EXPECT_THAT(first("CLASS C VAR a : INT; END_VAR a := 1; END_CLASS"), HasSubstr("a class has no body"));
  EXPECT_THAT(first("CLASS C END_CLASS PROGRAM main VAR c : C; END_VAR c(); END_PROGRAM"),
              HasSubstr("'c' is an instance of a class: call one of its methods"));
  EXPECT_THAT(first("FUNCTION f VAR_IN_OUT b : Base; END_VAR b(); END_FUNCTION "
                    "FUNCTION_BLOCK D EXTENDS Base END_FUNCTION_BLOCK "
                    "PROGRAM main VAR d : D; END_VAR f(b := d); END_PROGRAM"),
              HasSubstr("VAR_IN_OUT 'b' is Base, not D"));
}

TEST(Inheritance, WarnsOfAnOverrideWithoutTheWord) {
  const auto lines =
      inheritance_lines(std::string(base_block) +
                        "FUNCTION_BLOCK D EXTENDS Base METHOD scaled : INT scaled := 1; END_METHOD "
                        "END_FUNCTION_BLOCK\n");
  EXPECT_THAT(lines,
              testing::ElementsAre("t.st:9:38: warning: the method takes the place of 'scaled' of 'Base': "
                                   "write METHOD OVERRIDE"));
}

// k is used by the derived block alone.
TEST(Inheritance, CountsUsesOfDerivedBlocks) {
  EXPECT_THAT(
      inheritance_lines("FUNCTION_BLOCK A VAR k, l : INT; END_VAR END_FUNCTION_BLOCK\n"
                        "FUNCTION_BLOCK B EXTENDS A METHOD m k := 1; END_METHOD END_FUNCTION_BLOCK\n"),
      testing::ElementsAre("t.st:1:25: warning: the variable 'l' is not used"));
}

}  // namespace
}  // namespace trunnion::st
