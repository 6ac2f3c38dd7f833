// SPDX-License-Identifier: Apache-2.0
// The M functions of a machine, and the P of a dwell.
#include <gtest/gtest.h>

#include <stdexcept>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_with(const char* text) {
  TestMachine machine;
  machine.functions.emplace().add(text);
  return machine;
}

TEST(MFunctions, WhatTheMachineDoesNotHaveIsRefusedBeforeItsBlockMoves) {
  TestMachine machine = machine_with("3 4 5 19; 6; 7 8 9; 70-72");
  for (unsigned number = 0; number <= highest_m; number += number < 200 ? 1u : 199u) {
    if (number == 98 || number == 99 || number == 198) continue;  // calls and returns, of the control
    const bool known =
        number <= 9 || number == 19 || number == 29 || number == 30 || (number >= 70 && number <= 72);
    const Interpretation result = run(machine, "G0 X1 M" + std::to_string(number) + "\n");
    EXPECT_EQ(result.alarm.number, known ? AlarmNumber::none : AlarmNumber::unknown_m) << number;
    if (known) continue;
    EXPECT_TRUE(result.commands.empty()) << number;
    EXPECT_NE(std::string(result.alarm.text.data()).find(": M" + std::to_string(number)), std::string::npos);
  }
}

TEST(MFunctions, ABlockHoldsOneOfEachGroup) {
  TestMachine machine = machine_with("3 4 5 19; 6; 7 8 9; 10 11");
  for (const char* block : {"M8 M9", "M7 M8", "M10 M11", "M3 M5", "M8 M3 M9"})
    EXPECT_EQ(run(machine, std::string(block) + "\n").alarm.number, AlarmNumber::group_twice) << block;
  for (const char* block : {"M3 M8", "M10 M8 M3", "M5 M9 M30"})
    EXPECT_EQ(run(machine, std::string(block) + "\n").alarm.number, AlarmNumber::none) << block;
}

// G76 and G87 move across the bore with the spindle at its angle.
TEST(MFunctions, CyclesThatNeedM19AreRefusedWithoutIt) {
  const std::string bore = "S500 M3\nG76 X1 Z-5 R1 Q1 F100\n", back = "S500 M3\nG87 X1 Z5 R-5 Q1 F100\n";
  for (const auto& cycle : {bore, back}) {
    TestMachine without = machine_with("3 4 5"), with = machine_with("3 4 5 19");
    const Interpretation refused = run(without, cycle);
    EXPECT_EQ(refused.alarm.number, AlarmNumber::unknown_m) << cycle;
    EXPECT_NE(std::string(refused.alarm.text.data()).find("needs M19"), std::string::npos);
    EXPECT_EQ(run(with, cycle).alarm.number, AlarmNumber::none) << cycle;
  }
}

TEST(MFunctions, AListThatIsNoneNamesTheNumber) {
  const std::pair<const char*, const char*> cases[] = {{"3 10000", "'10000' is no M code: 0 to 9999"},
                                                       {"3,4", "',4' is no M code: 0 to 9999"},
                                                       {"3 4; 3", "M3 is there twice"},
                                                       {"30", "M30 belongs to the control"},
                                                       {"9-7", "M9-7 is no range"},
                                                       {"3 -4", "'' is no M code: 0 to 9999"}};
  for (const auto& [text, problem] : cases) {
    MFunctions functions;
    try {
      functions.add(text);
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), problem) << text;
    }
  }
}

TEST(MFunctions, CodesOfFourDigitsAreTheLogicsWhereTheListHasThem) {
  TestMachine machine = machine_with("3 4 5; 1000-1003; 9999");
  const Interpretation result = run(machine, "M1001\nG0 X1 M9999\n");
  EXPECT_EQ(stream(result), (std::vector<std::string>{"M1001", "M9999", "rapid X1", "end 0"}));
  EXPECT_EQ(run(machine, "M1000 M1003\n").alarm.number, AlarmNumber::group_twice);
  EXPECT_EQ(run(machine, "M1004\n").alarm.number, AlarmNumber::unknown_m);
}

double dwell_of(DwellPoint point, const std::string& line) {
  TestMachine machine;
  machine.point = point;
  const Interpretation result = run(machine, line + "\n");
  for (const Command& command : result.commands)
    if (command.kind == CommandKind::dwell) return command.dwell_seconds;
  ADD_FAILURE() << line << ": " << result.alarm.text.data();
  return -1;
}

TEST(Dwell, WithAPointIsInTheUnitThatTheMachineStates) {
  for (const char* line : {"G4 P1500", "G82 X1 Z-1 R1 P1500 F100"}) {
    for (const DwellPoint point : {DwellPoint::refused, DwellPoint::seconds, DwellPoint::milliseconds})
      EXPECT_EQ(dwell_of(point, line), 1.5);
  }
  for (const char* line : {"G4 P1.5", "G82 X1 Z-1 R1 P1.5 F100", "#1=1.5\nG4 P#1"}) {
    EXPECT_EQ(dwell_of(DwellPoint::seconds, line), 1.5);
    EXPECT_EQ(dwell_of(DwellPoint::milliseconds, line), 0.0015);
  }
  EXPECT_EQ(dwell_of(DwellPoint::seconds, "G4 P2."), 2);
  EXPECT_EQ(dwell_of(DwellPoint::refused, "G4 X1.5"), 1.5);
}

}  // namespace
}  // namespace trunnion::language::test
