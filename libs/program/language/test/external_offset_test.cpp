// SPDX-License-Identifier: Apache-2.0
// The external work offset, the numbers of G54 P, and the forms of G10 that add.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

TestMachine machine_with_external_offset() {
  TestMachine machine;
  machine.added = {1, 2, 3, 4, 0, 5, 0, 0, 0};
  machine.offsets[1] = {100, 200, 300, 10, 0, 20, 0, 0, 0};  // G55
  machine.more_offsets[48] = {7, 8, 9, 0, 0, 0, 0, 0, 0};    // G54.1 P48
  machine.tools[1] = {50, 0.5, 4, 0.1};
  return machine;
}

TEST(ExternalOffset, IsAddedToEveryWorkOffset) {
  TestMachine machine = machine_with_external_offset();
  EXPECT_THAT(stream(run(machine, "G0 X10 Y0 Z0 A0 C0\nG55 X10 A0\nG54.1 P48 X10\nG53 X10\nM30\n")),
              ElementsAre("rapid X11 Y2 Z3 A4 C5", "rapid X111 Y2 Z3 A14 C5", "rapid X18 Y2 Z3 A14 C5",
                          "rapid X10 Y2 Z3 A14 C5", "end 30"));
}

TEST(ExternalOffset, G10ChangesItAndTheNextWordIsInTheNewFrame) {
  TestMachine machine = machine_with_external_offset();
  EXPECT_THAT(stream(run(machine,
                         "G10 L2 P0 X50\nG0 X10\nG91 G10 L2 P0 X1 Y1\nG90 X10 Y0\n"
                         "G20 G91 G10 L2 P0 Z1\nG21 G90 G55 Z0\nM30\n")),
              // 50 + 10; 51 + 10 and 2 + 1; 300 + 3 + 25.4
              ElementsAre("table1 54 X50 Y2 Z3 A4 C5", "rapid X60", "table1 54 X51 Y3 Z3 A4 C5",
                          "rapid X61 Y3", "table1 54 X51 Y3 Z28.4 A4 C5", "rapid X61 Y3 Z328.4", "end 30"));
}

TEST(ExternalOffset, IsVariables5201AndFollowing) {
  TestMachine machine = machine_with_external_offset();
  EXPECT_THAT(stream(run(machine, "G0 X[#5201*10] Y#5206\n#5201=#5201+6\nG0 X0\nG20\n#5202=1\nG0 Y0\nM30\n")),
              // X 10 + 1, Y 5 + 2; X 0 + 7; Y 25.4
              ElementsAre("rapid X11 Y7", "table1 54 X7 Y2 Z3 A4 C5", "rapid X7 Y7",
                          "table1 54 X7 Y25.4 Z3 A4 C5", "rapid X7 Y25.4", "end 30"));
}

// A line of manual data input takes the tables as they are by then.
TEST(ExternalOffset, OfTheNextLineIsThatOfTheTable) {
  TestMachine machine = machine_with_external_offset();
  Interpreter interpreter(machine);
  const auto target = [&](const std::string& text, Beginning beginning) {
    StringSource source(text);
    interpreter.start(source, interpreter.position(), interpreter.modal(), no_variables, beginning);
    Command command;
    while (interpreter.next(command) == Step::command && command.kind == CommandKind::table) continue;
    return command.target[X];
  };
  EXPECT_EQ(target("G10 L2 P0 X30\nG0 X1\n", Beginning::program), 31);
  machine.added[X] = 40;
  EXPECT_EQ(target("G0 X1\n", Beginning::line), 41);
}

TEST(ExternalOffset, CannotChangeUnderCutterCompensation) {
  for (const char* change : {"G10 L2 P0 X1", "#5201=1"}) {
    TestMachine machine = machine_with_external_offset();
    const auto result = run(machine, std::string("G41 D1\n") + change + "\n");
    EXPECT_EQ(result.alarm.number, AlarmNumber::compensation_active) << change;
  }
}

TEST(WorkOffsetNumber, BelongsToG54WhereNoOtherCodeTakesP) {
  struct Case {
    const char* program;
    int index;  ///< as ModalState::work_offset
  };
  const Case cases[] = {
      {"G54 P1\n", 6},
      {"G54 P48\n", 53},
      {"G0 G90 G54 P7 X0 Y0 S100 M3\n", 12},
      {"G80 G54 P2\n", 7},
      {"G55\nG54 P2 M8\n", 7},
      // P is a time, a subprogram, a factor, a tolerance, a mode.
      {"G55\nG54 G4 P100\n", 0},
      {"G55\nG54 M98 P5\nM30\nO5\nM99\n", 0},
      {"G55\nG54 G51 X0 Y0 P2\n", 0},
      {"G55\nG54 G64 P0.1\n", 0},
      {"G55\nG54 G8 P1\n", 0},
      {"G55\nG54 G99 G82 Z-1 R1 P100 F100\n", 0},
      {"G55\nG99 G82 Z-1 R1 P100 F100\nG54 X5 P200\n", 0},
  };
  for (const Case& c : cases) {
    TestMachine machine = machine_with_external_offset();
    const auto result = run(machine, c.program);
    EXPECT_EQ(result.last, Step::end) << c.program << result.alarm.text.data();
    EXPECT_EQ(result.modal.work_offset, c.index) << c.program;
  }
}

TEST(WorkOffsetNumber, BeyondThoseOfTheControlSaysHowManyThereAre) {
  for (const char* program : {"G54 P49", "G54.1 P300", "G54 P0", "G10 L20 P49 X1"}) {
    TestMachine machine;
    const auto result = run(machine, std::string(program) + "\n");
    EXPECT_EQ(result.alarm.number, AlarmNumber::value_range) << program;
    EXPECT_TRUE(std::string(result.alarm.text.data()).ends_with(", this control has P1 to P48"))
        << result.alarm.text.data();
  }
}

TEST(TableCodes, IncrementalWordsAddInEveryForm) {
  TestMachine machine = machine_with_external_offset();
  EXPECT_THAT(stream(run(machine, "G91 G10 P1 Z1 R0.5\nG10 L1 P1 R0.25\nG90 G10 L1 P1 R0\nM30\n")),
              // Length 50 + 1, radius 4 + 0.5; L1 is the wear of the length as L11: 0.5 + 0.25
              ElementsAre("table2 1 51", "table4 1 4.5", "table3 1 0.75", "table3 1 0", "end 30"));
}

}  // namespace
}  // namespace trunnion::language::test
