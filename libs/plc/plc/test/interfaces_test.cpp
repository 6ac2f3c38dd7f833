// SPDX-License-Identifier: Apache-2.0
// Interfaces and their values.
#include <gmock/gmock.h>

#include <algorithm>

#include "plc/machine/verify.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

using testing::HasSubstr;

// The methods have their variables at other cells than the interface.
constexpr const char* two_devices =
    "INTERFACE Device METHOD start : BOOL VAR_INPUT speed : INT; END_VAR VAR_OUTPUT given : INT; END_VAR\n"
    "VAR_IN_OUT log : STRING; END_VAR END_METHOD END_INTERFACE\n"
    "INTERFACE Clock METHOD passed : TIME END_METHOD END_INTERFACE\n"
    "FUNCTION_BLOCK Pump IMPLEMENTS Device, Clock VAR_OUTPUT n : INT; END_VAR\n"
    "METHOD PUBLIC start : BOOL VAR k : ARRAY[0..6] OF INT; END_VAR VAR_INPUT speed : INT; END_VAR\n"
    "VAR_OUTPUT given : INT; END_VAR VAR_IN_OUT log : STRING; END_VAR\n"
    "k[n] := speed; n := n + 1; given := k[0] * 2; log := CONCAT(log, 'p'); start := TRUE; END_METHOD\n"
    "METHOD PUBLIC passed : TIME passed := T#3s; END_METHOD END_FUNCTION_BLOCK\n"
    "FUNCTION_BLOCK Valve IMPLEMENTS Device VAR_OUTPUT open : BOOL; END_VAR\n"
    "METHOD PUBLIC start : BOOL VAR_INPUT speed : INT; END_VAR VAR_OUTPUT given : INT; END_VAR\n"
    "VAR_IN_OUT log : STRING; END_VAR open := speed > 0; given := -speed; log := CONCAT(log, 'v'); "
    "END_METHOD\n"
    "END_FUNCTION_BLOCK\n"
    "FUNCTION_BLOCK BigValve EXTENDS Valve END_FUNCTION_BLOCK\n";

TEST(Interfaces, CallTheMethodOfTheInstance) {
  Translated program(
      "VAR p : Pump; v : Valve; b : BigValve; devices : ARRAY[0..2] OF Device; log : STRING; i : INT;\n"
      "given : ARRAY[0..2] OF INT; on : ARRAY[0..2] OF BOOL; END_VAR",
      "devices[0] := p; devices[1] := v; devices[2] := b;\n"
      "FOR i := 0 TO 2 DO on[i] := devices[i].start(speed := i + 5, given => given[i], log := log); END_FOR;",
      two_devices);
  EXPECT_EQ(verify(*program.compilation.code), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("on"), "[TRUE, FALSE, FALSE]");
  EXPECT_EQ(program.get("given"), "[10, -6, -7]");
  EXPECT_EQ(program.get("log"), "'pvv'");
  EXPECT_EQ(program.get("p.n"), "1");
  EXPECT_EQ(program.get("v.open") + program.get("b.open"), "TRUETRUE");
}

// A PLC's alarm, as an index outside an array is one; it names the call.
TEST(Interfaces, StopAtACallOfNull) {
  Translated program("VAR d : Device; log : STRING; v : Valve; set : BOOL; END_VAR",
                     "IF set THEN d := v; END_IF;\nd.start(1, log);\n", two_devices);
  const auto fault = program.scan();
  EXPECT_THAT(fault, HasSubstr("a reference to no variable"));
  EXPECT_THAT(fault, HasSubstr(":17:3:"));
  EXPECT_EQ(program.get("d"), "NULL");
  program.set("set", "TRUE");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("v.open"), "TRUE");
  EXPECT_THAT(program.get("d"), HasSubstr("an instance at cell "));
}

TEST(Interfaces, HaveValuesThatAreParametersResultsAndCompared) {
  Translated program(
      "VAR p : Pump; v : Valve; d, e, none : Device; same, other, empty : BOOL; log : STRING; r : Registry;\n"
      "own : Own; END_VAR",
      "d := chosen(first := p, second := v, takes_first := FALSE); e := v;\n"
      "same := d = e; other := d <> none; empty := none = NULL AND NULL <> d;\n"
      "r.add(p); r.add(d); own.enter(r); r.start(log);",
      std::string(two_devices) +
          "FUNCTION chosen : Device VAR_INPUT first, second : Device; takes_first : BOOL; END_VAR\n"
          "IF takes_first THEN chosen := first; ELSE chosen := second; END_IF; END_FUNCTION\n"
          "FUNCTION_BLOCK Registry VAR n : INT; list : ARRAY[0..3] OF Device; END_VAR\n"
          "METHOD add VAR_INPUT d : Device; END_VAR list[n] := d; n := n + 1; END_METHOD\n"
          "METHOD start VAR_IN_OUT log : STRING; END_VAR VAR i : INT; END_VAR\n"
          "FOR i := 0 TO n - 1 DO list[i].start(speed := 3, log := log); END_FOR; END_METHOD "
          "END_FUNCTION_BLOCK\n"
          "FUNCTION_BLOCK Own IMPLEMENTS Device\n"
          "METHOD start : BOOL VAR_INPUT speed : INT; END_VAR VAR_OUTPUT given : INT; END_VAR\n"
          "VAR_IN_OUT log : STRING; END_VAR log := CONCAT(log, 'o'); END_METHOD\n"
          "METHOD enter VAR_IN_OUT r : Registry; END_VAR r.add(THIS); END_METHOD END_FUNCTION_BLOCK\n");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("same") + program.get("other") + program.get("empty"), "TRUETRUETRUE");
  EXPECT_EQ(program.get("log"), "'pvo'");
}

TEST(Interfaces, AreAttemptedToBeAssigned) {
  Translated program(
      "VAR p : Pump; v : Valve; d : Device; c : Clock; a, b, e : TIME; END_VAR",
      "d := p; c ?= d; a := c.passed();\n"
      "d := v; c ?= d; IF c = NULL THEN b := T#1s; END_IF; c ?= p; IF c <> NULL THEN e := T#2s; END_IF;",
      two_devices);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("a") + program.get("b") + program.get("e"), "T#3sT#1sT#2s");
}

TEST(Interfaces, AreRefusedWithOneClearLine) {
  const auto first = [](const std::string& text, const std::string& run = "") {
    const auto lines = compile({{"t.st", two_devices + text +
                                             "\nPROGRAM main VAR d, e : Device; i : INT; t : TON; "
                                             "END_VAR " +
                                             run + " ; END_PROGRAM\n"}},
                               interface_registers())
                           .lines();
    const auto found = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find(": error: ") != std::string::npos;
    });
    return found == lines.end() ? std::string() : *found;
  };
  EXPECT_EQ(first("", "d := e;"), "");
  EXPECT_THAT(first("", "d := t;"),
              HasSubstr("expected an instance of a block that implements Device, found TON"));
  EXPECT_THAT(first("", "d := 5;"), HasSubstr("implements Device, found a number"));
  EXPECT_THAT(first("", "i := d;"), HasSubstr("expected INT, found Device"));
  EXPECT_THAT(first("", "d.stop();"), HasSubstr("the interface 'Device' has no method 'stop'"));
  EXPECT_THAT(first("", "IF d < e THEN ; END_IF;"), HasSubstr("references are compared by = and <> only"));
  EXPECT_THAT(first("", "i ?= d;"), HasSubstr("?= is for references and variables of an interface"));
  EXPECT_THAT(first("FUNCTION_BLOCK B IMPLEMENTS Clock END_FUNCTION_BLOCK"),
              HasSubstr("'B' has no method 'passed' for the interface 'Clock'"));
  EXPECT_THAT(first("FUNCTION_BLOCK B IMPLEMENTS Clock METHOD passed : INT END_METHOD END_FUNCTION_BLOCK"),
              HasSubstr("the method has other parameters or another result than 'Clock.passed'"));
  EXPECT_THAT(
      first("FUNCTION_BLOCK B IMPLEMENTS Clock METHOD PRIVATE passed : TIME END_METHOD END_FUNCTION_BLOCK"),
      HasSubstr("the method is that of an interface, 'Clock.passed': write METHOD PUBLIC"));
  EXPECT_THAT(first("FUNCTION_BLOCK B IMPLEMENTS Clok END_FUNCTION_BLOCK"),
              HasSubstr("there is no interface 'Clok'"));
  EXPECT_THAT(first("INTERFACE I EXTENDS I END_INTERFACE"), HasSubstr("the interface 'I' extends itself"));
  EXPECT_THAT(first("INTERFACE I METHOD m : INT m := 1; END_METHOD END_INTERFACE"),
              HasSubstr("a method of an interface has no statements"));
  EXPECT_THAT(first("VAR_GLOBAL RETAIN kept : Device; END_VAR"), HasSubstr("RETAIN is not permitted"));
  EXPECT_THAT(
      first("FUNCTION_BLOCK B VAR d : Device; END_VAR END_FUNCTION_BLOCK VAR_GLOBAL RETAIN b : B; END_VAR"),
      HasSubstr("'b' names a variable by its place"));
  EXPECT_THAT(first("FUNCTION_BLOCK Chain IMPLEMENTS Clock VAR next : Clock; END_VAR\n"
                    "METHOD passed : TIME passed := next.passed(); END_METHOD END_FUNCTION_BLOCK"),
              HasSubstr("'Chain.passed' calls or contains itself"));
}

// New programs have their variables at other places, and the numbers of the blocks may be others.
TEST(Interfaces, BeginWithTheirInitialValuesInNewPrograms) {
  const auto translated = [](const std::string& text) {
    return compile({{"t.st", two_devices + text +
                                 "PROGRAM main VAR n : INT; d : Device; END_VAR n := 1; d := NULL; "
                                 "END_PROGRAM\n"}},
                   interface_registers());
  };
  const auto running = translated("");
  const auto next = translated(
      "FUNCTION_BLOCK Another IMPLEMENTS Clock METHOD passed : TIME END_METHOD END_FUNCTION_BLOCK\n");
  ASSERT_TRUE(running.good() && next.good()) << testing::PrintToString(next.lines());
  EXPECT_NE(running.layout(), next.layout());
  EXPECT_EQ(running.layout(), translated("").layout());
  const Changeover change{Variables(running), Variables(next)};
  EXPECT_THAT(change.losses(),
              testing::ElementsAre("main.d (Device) names a variable by its place: it begins with "
                                   "its initial value"));
  ASSERT_EQ(change.moves().size(), 1u);
  EXPECT_EQ(change.moves()[0].path, "main.n");
}

}  // namespace
}  // namespace trunnion::st
