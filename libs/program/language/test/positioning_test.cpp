// SPDX-License-Identifier: Apache-2.0
// Positioning codes, modal values that are passed on, spindle modes, helices and skip moves.
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TEST(Positioning, ValuesThatArePassedOn) {
  TestMachine machine = machine_with_references();
  const Interpretation result =
      run(machine, "G92 S3000\nG96 S100\nG5.1 Q2\nG64 P0.02 Q0.01\nG98 G1 X1 F10\nG99 G9 X2\nX3\nG61 X4\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  ASSERT_EQ(result.commands.size(), 6u);
  const ModalState& first = result.commands[1].modal;
  EXPECT_EQ(first.spindle_limit, 3000);
  EXPECT_EQ(first.spindle_mode, SpindleMode::surface);
  EXPECT_EQ(first.surface_speed, 100);
  EXPECT_EQ(first.smoothing, 2);
  EXPECT_EQ(first.path_tolerance, 0.02);
  EXPECT_TRUE(first.return_to_initial);
  // G9 stops in its own block only.
  EXPECT_EQ(result.commands[2].modal.path_control, PathControl::exact_stop);
  EXPECT_FALSE(result.commands[2].modal.return_to_initial);
  EXPECT_EQ(result.commands[3].modal.path_control, PathControl::continuous);
  EXPECT_EQ(result.commands[4].modal.path_control, PathControl::exact_stop);
}

TEST(Positioning, SpindleDirectionIsModal) {
  TestMachine machine;
  const Interpretation result = run(machine, "M3 G0 X1\nM4\nX2\nM19\nX3 M5\n");
  ASSERT_EQ(result.commands.size(), 8u);
  EXPECT_EQ(result.commands[1].modal.spindle_direction, SpindleDirection::cw);
  EXPECT_EQ(result.commands[3].modal.spindle_direction, SpindleDirection::ccw);
  EXPECT_EQ(result.commands[5].modal.spindle_direction, SpindleDirection::stopped);
}

TEST(Skip, NothingIsReadBeforeThePositionIsKnown) {
  TestMachine machine = machine_with_references();
  StringSource text("G55 G91 G31 X20 F100 M8\nX1 G0\nG90 X1\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::auxiliary);
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::skip);
  EXPECT_EQ(command.target[X], 20);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(interpreter.next(command), Step::position);
  interpreter.set_position({12.5});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 13.5);
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 101);
  EXPECT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::end);
}

TEST(Skip, WithoutAWayThereIsNothingToWaitFor) {
  TestMachine machine;
  StringSource text("G31 X0 F1\nG0 X1\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::rapid);
}

}  // namespace
}  // namespace trunnion::language::test
