// SPDX-License-Identifier: Apache-2.0
// Homing by programs of the NUM dialect, as the manual prints them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "num_program.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

// X 1, Z 4, C 32.
TEST(NumHoming, G159NamesAxesWithOrWithoutANumber) {
  EXPECT_THAT(num_stream("F2000 G159 C\nM2"), ElementsAre("home32 F2000", "end 2"));
  EXPECT_THAT(num_stream("G159 C X Z (all)\nM2"), ElementsAre("home37", "end 2"));
  EXPECT_THAT(num_stream("G159XZ$ home\nM2"), ElementsAre("message 10000", "home5", "end 2"));
  EXPECT_THAT(num_stream("G159 X0 Z\nM2"), ElementsAre("home5", "end 2"));
  // F is the speed of the search only.
  EXPECT_THAT(num_stream("G94 F100\nF2000 G159 X\nG1 X1\nM2"),
              ElementsAre("home1 F2000", "line X1 F100", "end 2"));
}

TEST(NumHoming, TheControlCarriesOut9990Point9) {
  // Z U A in the numbers of L0; their bits are 2, 6 and 3.
  EXPECT_THAT(num_stream("L0=2 F2000 G77 H9990.9 (axe Z)\nL0=3 G77 H9990.9\nL0=6 F10 G77 H9990.9\nM2"),
              ElementsAre("home4 F2000", "home64 F2000", "home8 F10", "end 2"));
  // Behind the words of its block; also from another program, and in a loop.
  EXPECT_THAT(num_stream("L0=1 X5 G77 H9990.9\nG77 H7\nM2\n%7\nL0=0\nWHILE L0<2 DO G77 H9990.9\n"
                         "L0=L0+1\nENDW\n"),
              ElementsAre("rapid X5", "home2 X5", "home1", "home2", "end 2"));
  // 10 inch/min; F per revolution is no speed of the search.
  EXPECT_THAT(num_stream("G70 L0=2 F10 G77 H9990.9\nG95 F.1 G77 H9990.9\nM2"),
              ElementsAre("home4 F10", "home4", "end 2"));
  // An axis that the channel does not have is left out.
  TestMachine machine = num_machine();
  machine.axis_mask = 0b000000101;
  EXPECT_THAT(stream(run(machine, "L0=0 G77 H9990.9\nL0=1 G77 H9990.9\nL0=2 G77 H9990.9\nM2")),
              ElementsAre("home1", "home4", "end 2"));
  TestMachine iso;
  EXPECT_EQ(run(iso, "M98 P9990 L1").alarm.number, AlarmNumber::subprogram_missing);
}

// 1 as E91124 says it of spindles: not homed. X, Z and W had their references when the program began; C is
// bit 5, W bit 8.
TEST(NumHoming, AProgramCanAskWhichAxesAreNotHomed) {
  TestMachine machine = num_machine();
  StringSource source(
      "L1=E91100 L2=E91101 L3=E91105 L8=E91108\nXL1 YL2 ZL3 CL8\nWHILE E91108=1 DO L0=8 G77 H9990.9\nENDW\n"
      "Y4\nM2");
  Interpreter interpreter(machine);
  interpreter.set_homed(0b100000101);
  interpreter.start(source, {}, {});
  Interpretation result;
  Command command;
  do {
    result.last = interpreter.next(command);
    if (result.last == Step::command) result.commands.push_back(command);
    if (result.last == Step::position) interpreter.set_position(command.target);
  } while (result.last == Step::command || result.last == Step::position);
  // The search ends at the reference position of C, 0.
  EXPECT_THAT(stream(result), ElementsAre("rapid Y1 C1", "home32 Y1", "rapid Y4", "end 2"));
  interpreter.set_homed(std::nullopt);
  StringSource again("L1=E91100\nM2");
  interpreter.start(again, {}, {});
  EXPECT_EQ(interpreter.next(command), Step::alarm);
  EXPECT_EQ(interpreter.alarm().number, AlarmNumber::homed_unknown);
  machine.axis_mask = 0b000000101;
  EXPECT_EQ(run(machine, "L1=E91101").alarm.number, AlarmNumber::num_parameter_unavailable);
}

// The examples are as they are printed, comments translated. Z and X at their own feeds, Y at that of X, C.
// The condition does not hold, because G159 is carried out without these programs.
TEST(NumHoming, ThePrintedProgramForOneGroupRuns) {
  EXPECT_THAT(
      num_stream("$9990\n\nIF [.RG80] = 159 THEN (called by G159)\n   G77 H9990.9\n\nELSE (called in homing "
                 "mode: put the number of the axis into L0)\n        (Perhaps program the feed Fxxx)\n   "
                 "L0=2 F2000 G77 H9990.9 (axis Z)\n   L0=0 F3000 G77 H9990.9 (axis X)\n   L0=1 G77 H9990.9 "
                 "(axis Y)\n   L0=8 F10000 G77 H9990.9 (axis C)\nM2\n"),
      ElementsAre("message 10000", "home4 F2000", "home1 F3000", "home2 F3000", "home32 F10000", "end 2"));
}

// Neither has ENDI; the first one ends with M2, the second one with its text.
const std::string group_1 =
    "%9990.1 (Homing on group 1)\nIF [.RG80] = 159 THEN (call by G159)\n   G77 H9990.9\nELSE (call in homing "
    "mode: load axis no. in L0)\n     (programme the feed rate Fxxx if required)\n   L0=2 F2000 G77 "
    "H9990.9(Z "
    "axis)\n   G78 Q1 P1.2 (Wait for homing on Z on another group)\n   L0=0 F3000 G77 H9990.9(X axis)\n   "
    "L0=1 "
    "G77 H9990.9(Y axis)\n   L0=8 F10000 G77 H9990.9(C axis)\n  M2\n";

const std::string group_2 =
    "%9990.2 (Homing on group 2)\nIF [.RG80] = 159 THEN (call by G159)\n   G77 H9990.9\nELSE (call in homing "
    "mode: load axis no. in L0)\n    (programme the feed rate Fxxx if required)\n   L0=2 F2000 G77 H9990.9 "
    "(Z "
    "axis)\n   G78 Q1 P1.1 (Wait for homing on Z on another group)\n   L0=0 F3000 G77 H9990.9(X axis)\n   "
    "L0=1 "
    "G77 H9990.9(Y axis)\n";

std::string without_wait_mark(std::string program) {
  const auto begin = program.find("   G78");
  return program.erase(begin, program.find('\n', begin) + 1 - begin);
}

TEST(NumHoming, ThePrintedProgramsForTwoGroupsRunButForTheirWaitMarks) {
  EXPECT_THAT(num_stream(group_1 + group_2), ElementsAre("home4 F2000", "alarm 1152 7:4"));
  EXPECT_THAT(num_stream(group_2), ElementsAre("home4 F2000", "alarm 1152 7:4"));
  EXPECT_THAT(num_stream(without_wait_mark(group_1) + group_2),
              ElementsAre("home4 F2000", "home1 F3000", "home2 F3000", "home32 F10000", "end 2"));
  EXPECT_THAT(num_stream(without_wait_mark(group_2)),
              ElementsAre("home4 F2000", "home1 F3000", "home2 F3000", "end 0"));
  // As manual data input calls it, and with another program behind it.
  EXPECT_THAT(num_stream("G77 H9990.2\nM8\nM2\n" + without_wait_mark(group_2) + group_1),
              ElementsAre("home4 F2000", "home1 F3000", "home2 F3000", "M8", "end 2"));
}

// On a NUM control G159 calls the programs, and the condition holds. Here one that holds stands in its place:
// the axis is in L0, and nothing of the other branch is carried out, although no ENDI ends it.
TEST(NumHoming, TheBranchOfG159HomesTheAxisOfL0Alone) {
  for (auto program : {without_wait_mark(group_1), without_wait_mark(group_2)}) {
    program.replace(program.find("159 THEN"), 3, "80");
    EXPECT_THAT(num_stream("L0=8 F500\nG77 H" + program.substr(1, 6) + "\nM2\n" + program),
                ElementsAre("home32 F500", "end 2"));
  }
}

}  // namespace
}  // namespace trunnion::language::test
