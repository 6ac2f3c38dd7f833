// SPDX-License-Identifier: Apache-2.0
// CONFIGURATION, RESOURCE and TASK: which programs run when, with which variables.
#include <gmock/gmock.h>

#include "checked_compilation.hpp"
#include "plcopen_documents.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

using testing::HasSubstr;

const std::string counter =
    "PROGRAM counter\nVAR_INPUT step : INT := 1; END_VAR\nVAR_OUTPUT total : INT; END_VAR\n"
    "total := total + step;\nEND_PROGRAM\n";

std::string configuration(const std::string& inside) {
  return "CONFIGURATION machine\nRESOURCE plc ON PLC\n" + inside + "END_RESOURCE\nEND_CONFIGURATION\n";
}

std::string first_line(const std::string& source) {
  const auto lines = compile({{"c.st", source}}, interface_registers()).lines();
  return lines.empty() ? "" : lines.front();
}

TEST(Configuration, InstancesOfOneProgramHaveVariablesOfTheirOwn) {
  Translated program(counter + configuration("TASK normal(INTERVAL := T#10ms, PRIORITY := 1);\n"
                                             "PROGRAM ones WITH normal : counter;\n"
                                             "PROGRAM threes WITH normal : counter(step := 3);\n"),
                     0);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("ones.total"), "4");
  EXPECT_EQ(program.get("threes.total"), "12");
}

TEST(Configuration, ConnectionsReadAndWriteGlobalVariablesAndRegisters) {
  Translated program(
      counter +
          "CONFIGURATION machine\nVAR_GLOBAL sum : INT; shown AT %W10 : INT; END_VAR\nRESOURCE plc ON PLC\n"
          "VAR_GLOBAL width : INT := 5; END_VAR\nTASK normal(INTERVAL := T#10ms);\n"
          "PROGRAM a WITH normal : counter(step := width, total => sum);\n"
          "PROGRAM b WITH normal : counter(step := sum, total => shown);\n"
          "END_RESOURCE\nEND_CONFIGURATION\nPROGRAM unused\nEND_PROGRAM\n",
      0);
  // b runs behind a, so it sees the sum of the same scan: 5, then 5 + 10.
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("sum"), "10");
  EXPECT_EQ(program.get("%W10"), "15");
}

TEST(Configuration, ProgramsRunByPriorityThenInTheOrderOfTheirDeclaration) {
  const std::string digit =
      "VAR_GLOBAL order : DINT; END_VAR\nPROGRAM digit\nVAR_INPUT n : DINT; END_VAR\n"
      "order := order * 10 + n;\nEND_PROGRAM\n";
  Translated program(digit + configuration("TASK late(INTERVAL := T#10ms, PRIORITY := 9);\n"
                                           "TASK soon(INTERVAL := T#10ms, PRIORITY := 2);\n"
                                           "TASK quick(INTERVAL := T#1ms, PRIORITY := 0);\n"
                                           "PROGRAM p1 : digit(n := 1);\n"
                                           "PROGRAM p2 WITH late : digit(n := 2);\n"
                                           "PROGRAM p3 WITH soon : digit(n := 3);\n"
                                           "PROGRAM p4 WITH late : digit(n := 4);\n"
                                           "PROGRAM p5 WITH quick : digit(n := 5);\n"),
                     0);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("order"), "53241");
}

TEST(Configuration, LongIntervalsAreKeptWhateverTheScansInBetween) {
  Translated program(
      counter + configuration("TASK normal(INTERVAL := T#10ms);\nTASK slow(INTERVAL := T#30ms);\n"
                              "PROGRAM n WITH normal : counter;\nPROGRAM s WITH slow : counter;\n"),
      0);
  // At 0, 5, 10 .. 95 ms: 20 scans; s at 0, 30, 60 and 90 ms.
  for (int i = 0; i < 20; ++i) EXPECT_EQ(program.scan(5000000), "");
  EXPECT_EQ(program.get("n.total"), "20");
  EXPECT_EQ(program.get("s.total"), "4");
  // Scans without time, as after a change of an input, do not call it.
  for (int i = 0; i < 3; ++i) EXPECT_EQ(program.scan(0), "");
  EXPECT_EQ(program.get("s.total"), "4");
}

TEST(Configuration, ATimerOfASlowProgramLetsTimePassUpToItsNextCall) {
  Translated program("PROGRAM wait\nVAR t : TON; END_VAR\nt(IN := TRUE, PT := T#20ms);\nEND_PROGRAM\n" +
                         configuration("TASK slow(INTERVAL := T#50ms);\nPROGRAM w WITH slow : wait;\n"),
                     0);
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.run.machine().next_timer_end(0), 20000000);
  EXPECT_EQ(program.scan(20000000), "");  // the timer has ended, its program runs at 50 ms
  EXPECT_EQ(program.get("w.t.Q"), "FALSE");
  EXPECT_EQ(program.run.machine().next_timer_end(20000000), 50000000);
  EXPECT_EQ(program.scan(30000000), "");
  EXPECT_EQ(program.get("w.t.Q"), "TRUE");
  EXPECT_EQ(program.run.machine().next_timer_end(50000000), std::nullopt);
}

TEST(Configuration, RetainOfAnInstanceKeepsAllItsVariables) {
  const auto result = compile(
      {{"c.st", counter + configuration("TASK t(INTERVAL := T#10ms);\nPROGRAM RETAIN k WITH t : counter;\n"
                                        "PROGRAM l WITH t : counter;\n")}},
      interface_registers());
  const Variables variables(checked(result));
  EXPECT_TRUE(variables.find("k.total").retained);
  EXPECT_FALSE(variables.find("l.total").retained);
}

TEST(Configuration, TestsCallInstances) {
  const auto result = compile(
      {{"c.st", counter + configuration("TASK t(INTERVAL := T#10ms);\nPROGRAM k WITH t : counter;\n") +
                    "TEST 'an instance'\nk(step := 4); k();\nASSERT_EQ(k.total, 8);\nEND_TEST\n"}},
      interface_registers());
  const auto tests = run_tests(checked(result));
  ASSERT_EQ(tests.size(), 1u);
  EXPECT_TRUE(tests[0].passed) << tests[0].message;
}

TEST(Configuration, IsTheSameInPlcopen) {
  const auto document = project(
      pou("counter", "program",
          "<inputVars><variable name=\"step\"><type><INT/></type><initialValue><simpleValue value=\"1\"/>"
          "</initialValue></variable></inputVars><outputVars><variable "
          "name=\"total\"><type><INT/></type></variable>"
          "</outputVars>",
          "<ST><xhtml>total := total + step;</xhtml></ST>"),
      "",
      "<configuration name=\"c\"><resource name=\"r\">"
      "<task name=\"quick\" interval=\"PT0.001S\" priority=\"0\"><pouInstance name=\"q\" "
      "typeName=\"counter\"/></task>"
      "<task name=\"slow\" interval=\"T#20ms\" priority=\"1\"><pouInstance name=\"s\" "
      "typeName=\"counter\"/></task>"
      "<pouInstance name=\"free\" typeName=\"counter\"/>"
      "<globalVars><variable name=\"g\"><type><INT/></type></variable></globalVars>"
      "</resource></configuration>");
  const auto result = compile({{"c.xml", document}}, interface_registers());
  SourceRun run(checked(result));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(run.scan("").kind, FaultKind::none);  // 0, 10, 20, 30 ms
  EXPECT_EQ(run.get("q.total"), "4");
  EXPECT_EQ(run.get("s.total"), "2");
  EXPECT_EQ(run.get("free.total"), "4");
  EXPECT_EQ(run.get("g"), "0");
}

TEST(Configuration, WhatIsWrongIsSaidAtItsPlace) {
  const auto with = [](const std::string& inside) { return first_line(counter + configuration(inside)); };
  // The parts of the resource begin in line 7 + 2.
  EXPECT_EQ(with("TASK t(INTERVAL := T#5ms);\nPROGRAM a WITH t : counter;\n"),
            "c.st:8:20: error: the PLC has the intervals T#1ms and T#10ms and multiples of T#10ms");
  EXPECT_EQ(with("TASK t(PRIORITY := 1);\nPROGRAM a WITH t : counter;\n"),
            "c.st:8:6: error: the task 't' has no INTERVAL: write INTERVAL := T#10ms");
  EXPECT_EQ(
      with("TASK t(SINGLE := x);\nPROGRAM a WITH t : counter;\n"),
      "c.st:8:8: error: a task begins by its INTERVAL; instead of SINGLE test for the edge in the program");
  EXPECT_EQ(with("PROGRAM a WITH t : counter;\n"), "c.st:8:16: error: there is no TASK 't'");
  EXPECT_EQ(with("PROGRAM b : counter;\nPROGRAM a : conter;\n"),
            "c.st:9:13: error: there is no PROGRAM 'conter'");
  EXPECT_EQ(with("PROGRAM a : counter;\nPROGRAM a : counter;\n"),
            "c.st:9:9: error: the name 'a' is declared already");
  EXPECT_EQ(with("PROGRAM a : counter(stop := 1);\n"), "c.st:8:21: error: 'counter' has no parameter 'STOP'");
  EXPECT_EQ(with("PROGRAM a : counter(total => 5);\n"),
            "c.st:8:30: error: a value cannot be written here: a variable is required");
  EXPECT_EQ(with("VAR_ACCESS a : plc.b : INT; END_VAR\nPROGRAM a : counter;\n"),
            "c.st:8:1: error: VAR_ACCESS is not available: others read and write variables by their path, as "
            "instance.variable");
  EXPECT_THAT(with("VAR_CONFIG END_VAR\n"), HasSubstr("c.st:8:1: error: VAR_CONFIG is not available"));
  EXPECT_THAT(with("PROGRAM a : counter;\nEND_RESOURCE\nRESOURCE second ON PLC\n"),
              HasSubstr("c.st:10:1: error: the PLC is one RESOURCE"));
  EXPECT_THAT(with("TASK t(INTERVAL := T#10ms);\nTASK t(INTERVAL := T#10ms);\nPROGRAM a WITH t : counter;\n"),
              HasSubstr("c.st:9:6: error: the task 't' is declared twice"));
  EXPECT_THAT(first_line(counter + configuration("PROGRAM a : counter;\n") + configuration("")),
              HasSubstr("error: there is the CONFIGURATION 'machine' already"));
  EXPECT_THAT(with(""), HasSubstr("c.st:1:9: warning: the program 'counter' has no instance"));
}

}  // namespace
}  // namespace trunnion::st
