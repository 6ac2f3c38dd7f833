// SPDX-License-Identifier: Apache-2.0
// Values of spindles and their synchronization in programs of both dialects.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "num_program.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

// The values that the program asks for, one after the other; 0 when there are no more.
std::vector<std::string> with_values(Environment& machine, const std::string& text,
                                     std::vector<double> values, InterpreterOptions options = {}) {
  StringSource source(text);
  Interpreter interpreter(machine, options);
  interpreter.start(source, {}, {});
  Interpretation result;
  Command command;
  std::size_t next = 0;
  do {
    result.last = interpreter.next(command);
    if (result.last == Step::command) result.commands.push_back(command);
    if (result.last != Step::value) continue;
    EXPECT_EQ(result.commands.back().kind, CommandKind::read);
    EXPECT_EQ(interpreter.next(command), Step::value) << "nothing is read before the value";
    interpreter.give_value(next < values.size() ? values[next] : 0);
    ++next;
  } while (result.last != Step::end && result.last != Step::alarm && result.commands.size() < 1000);
  result.alarm = interpreter.alarm();
  EXPECT_GE(next, values.size()) << "it has asked for fewer";
  return stream(result);
}

// Command::number is 8 times the place of the value in SpindleValue and the spindle: homed 0, synchronized 8,
// master 16, error 24, reference 32, angle 40.
TEST(NumSpindles, ALoopReadsTheStateAgainEachTime) {
  TestMachine machine = num_machine();
  EXPECT_THAT(with_values(machine, "WHILE E93525=0 DO G4 F.5 $\nENDW\nX1\nM2", {0, 0, 1}),
              ElementsAre("read 9", "dwell 0.5", "read 9", "dwell 0.5", "read 9", "rapid X1", "end 2"));
  EXPECT_THAT(with_values(machine, "WHILE E91124=1 DO $Homing\nM64M40M3S50\nENDW\nM2", {0, 1}),
              ElementsAre("read 0", "message 10000", "M64", "S50", "M40", "M3", "read 0", "end 2"));
}

// 90 deg of 360 are 25000 of 100000 and 16384 of 65536; master 2 is address 24 + 1.
TEST(NumSpindles, ValuesAreInTheUnitsOfTheParameters) {
  TestMachine machine = num_machine();
  EXPECT_THAT(
      with_values(machine, "XE90100\nYE95224\nZE90200\nAE94125\nM2", {90, -90, -1500, 2}),
      ElementsAre("read 40", "rapid X25000", "read 24", "rapid X25000 Y-16384", "read 32",
                  "rapid X25000 Y-16384 Z-1500", "read 17", "rapid X25000 Y-16384 Z-1500 A25", "end 2"));
  EXPECT_THAT(with_values(machine, "XE94125 YE[POM_B1]\nM2", {0, 1}),
              ElementsAre("read 17", "read 0", "rapid X-1", "end 2"));
}

// Without the taking back L0 would be 3 and L2 4 behind two values.
TEST(NumSpindles, ALineThatAsksHasNoEffectBefore) {
  TestMachine machine = num_machine();
  EXPECT_THAT(with_values(machine, "L2=2\nL0=L0+1 L2=L2*L2 L1=E93524+E93525 E98024=E93524\nXL0 YL1 ZL2\nM2",
                          {1, 1, 1}),
              ElementsAre("read 8", "read 9", "read 8", "alarm 1156 2:35"));
  machine.external = {{98024, 300}};
  EXPECT_THAT(with_values(machine, "L2=2\nL0=L0+1 L2=L2*L2 L1=E93524+E93525\nXL0 YL1 ZL2\nM2", {1, 1}),
              ElementsAre("read 8", "read 9", "rapid X1 Y2 Z4", "end 2"));
}

TEST(NumSpindles, AMasterNeedsTheMarksOfBothAndTheAlarmNamesTheSpindle) {
  TestMachine machine = num_machine();
  EXPECT_THAT(with_values(machine, "EC90\nE94125=24\nE94125=-1\nM2", {1, 1}),
              ElementsAre("order 0 90", "read 0", "read 1", "order 94125 24", "order 94125 -1", "end 2"));
  EXPECT_THAT(with_values(machine, "E94124=27", {1, 0}), ElementsAre("read 3", "read 0", "alarm 1139 1:1"));
}

// Lead 2, taught at Z-13 with the spindle at 90 deg: from Z5 it is 18 mm, 9 revolutions.
TEST(NumSpindles, TheAngleOfASynchronizationIsNotThatOfAThread) {
  TestMachine machine = num_machine();
  EXPECT_THAT(
      with_values(machine, "M3 S500 EC45\nG0 Z5\nG33 Z-20 K2 EC90 EZ-13\nEC30\nM2", {}),
      ElementsAre("order 0 45", "S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "order 0 30", "end 2"));
  // Between threads it is in a block of its own or with another motion; a tap may have it.
  EXPECT_THAT(with_values(machine, "M3 S60\nG38 K2 Z-1\nEC90\nG0 X2 EC60\nG84 Z-5 K1 EC0 M5\nM2", {}),
              ElementsAre("S60", "M3", "thread Z-1 lead2", "order 0 90", "order 0 60", "rapid X2 Z-1",
                          "order 0 0", "M5", "tap X2 Z-5 lead1", "tap X2 Z-1 lead1", "M5", "end 2"));
}

// E98025=-E98025 is only an order: the time stays.
TEST(NumSpindles, TheIntegralTimeIsAParameterAndItsSignAnOrder) {
  TestMachine machine = num_machine();
  machine.external = {{98025, 400}};
  EXPECT_THAT(
      with_values(machine, "XE98025\nE98025=500\nE98025=-E98025\nYE98025\nE98025=-E98025\nE98025=0\nM2", {}),
      ElementsAre("rapid X400", "table6 100025 500", "order 98025 500", "order 98025 -500",
                  "rapid X400 Y-500", "order 98025 500", "order 98025 0", "end 2"));
}

TEST(NumSpindles, ParametersAreWrittenAsByG10AndReadAgain) {
  TestMachine machine = num_machine();
  machine.external = {{90330, 9000}};
  EXPECT_THAT(with_values(machine, "E90330=20000\nXE90330\nE91024=0 X1\nM2", {}),
              ElementsAre("table6 100330 20000", "rapid X20000", "rapid X1", "end 2"));
}

// As printed but for the S50% of its fifth line, whose % is a misprint. Spindle 1 has passed its mark,
// spindle 2 does so in the first pass; both are synchronized at the second question.
TEST(NumSpindles, TheProgramOfTheManualRuns) {
  TestMachine machine = num_machine();
  for (const std::uint32_t number :
       {90330u, 90331u, 90370u, 90371u, 90380u, 90381u, 90321u, 98025u, 90360u, 90361u})
    machine.external[number] = 0;
  const auto commands = with_values(machine,
                                    "(SPEED CONTROLLED SPINDLE SYNCHRONISATION)\n(MASTER = B1 SLAVE = B2)\n"
                                    "WHILE E91124=1 DO $Homing on spindle 1\nM64M40M3S50\nENDW\n"
                                    "WHILE E91125=1 DO $Homing on broche 2\nM65M40M3S50\nENDW\n"
                                    "E94124=-1\nE94125=-1\nE91024=0\nE91025=0\nE90330=20000\nE90331=20000\n"
                                    "E90370=1500\nE90371=1500\nE90380=4000\nE90381=4000\nE90321=500\n"
                                    "E98025=500\nE90360=1\nE90361=1000\nM64 M40 M4 S100 EC0\n"
                                    "M65 M40 M4 S100\nE94125=24\nWHILE E93525=0 DO G4 F.5 $\nENDW\n"
                                    "$SYNCHRO OK\nM64 M40 M3 S2000\n"
                                    "WHILE E93525=0 DO G4 F.5 $Wait for synchronisation at 2000 rpm\nENDW\n"
                                    "E98025=-E98025\nG4 F5\nE98025=-E98025\nG4 F5\nM2\n",
                                    {1, 0, 1, 1, 1, 0, 1, 0, 1});
  EXPECT_THAT(
      commands,
      ElementsAre("read 0", "read 1", "message 10000", "M65", "S50", "M40", "M3", "read 1", "order 94124 -1",
                  "order 94125 -1", "table6 100330 20000", "table6 100331 20000", "table6 100370 1500",
                  "table6 100371 1500", "table6 100380 4000", "table6 100381 4000", "table6 100321 500",
                  "table6 100025 500", "order 98025 500", "table6 100360 1", "table6 100361 1000",
                  "order 0 0", "M64", "S100", "M40", "M4", "M65", "S100", "M40", "M4", "read 0", "read 1",
                  "order 94125 24", "read 9", "dwell 0.5", "read 9", "message 10000", "M64", "S2000", "M40",
                  "M3", "read 9", "message 10000", "dwell 0.5", "read 9", "order 98025 -500", "dwell 5",
                  "order 98025 500", "dwell 5", "end 2"));
}

// #4811 + 10 is the master of spindle 1: variables count from 1.
TEST(IsoSpindles, SystemVariablesReadTheStateAndOrderTheSynchronization) {
  TestMachine machine;
  EXPECT_THAT(with_values(machine,
                          "WHILE #4802 EQ 0\nM3\nENDW\n#4880=30\n#4822=1\n#4872=2\nG0 X#4812 Y#4842\n"
                          "IF #4832 GT 1\nX5\nELSEIF #4832 GT 0.25\nX6\nENDIF\n#4822=0\nM30",
                          {0, 1, 1, 1, 1, 500, 0.5, 0.5}),
              ElementsAre("read 1", "M3", "read 1", "order 0 30", "read 0", "read 1", "order 94125 24",
                          "order 98025 -1", "read 9", "read 33", "rapid X1 Y500", "read 25", "read 25",
                          "rapid X6 Y500", "order 94125 -1", "end 30"));
  EXPECT_EQ(run(machine, "#4821=1").alarm.number, AlarmNumber::variable_value) << "itself";
  EXPECT_EQ(run(machine, "#4872=3").alarm.number, AlarmNumber::variable_value);
  EXPECT_EQ(run(machine, "#4811=1").alarm.number, AlarmNumber::variable_read_only);
  const Interpretation result = run(machine, "#4822=1");
  EXPECT_EQ(result.alarm.number, AlarmNumber::spindle_without_mark);
  EXPECT_NE(std::string(result.alarm.text.data()).find("spindle 1"), std::string::npos);
}

}  // namespace
}  // namespace trunnion::language::test
