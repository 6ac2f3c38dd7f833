// Positioning codes, modal values that are passed on, spindle modes, helices and skip moves.
#include <gtest/gtest.h>

#include "golden.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_with_references() {
  TestMachine machine;
  machine.reference = {500, 400, 300, 0, 0, 0, 0, 0, 0};
  machine.further_references[2] = {50, 60, 70, 0, 0, 0, 0, 0, 0};
  machine.further_references[4] = {-50, 60, 70, 0, 0, 0, 0, 0, 0};
  machine.last_way = {0.5, -0.25, 0, 0, 0, 2, 0, 0, 0};
  machine.offsets[1] = {100, 0, 0, 0, 0, 0, 0, 0, 0};
  return machine;
}

TEST(Positioning, Streams) {
  TestMachine machine = machine_with_references();
  const Golden goldens[] = {
      {"further reference positions, the second without P",
       "G30 P4 X1\nG30 Y2\n",
       {"rapid X1", "rapid X-50", "rapid X-50 Y2", "rapid X-50 Y60", "end 0"}},
      {"back over the point of the way there",
       "G91 G28 X10 Z20\nG90 G29 X3 Z4\n",
       {"rapid X10 Z20", "rapid X500 Z300", "rapid X10 Z20", "rapid X3 Z4", "end 0"}},
      {"the way back takes only the axes named",
       "G28 X10 Z20\nG29 X3\n",
       {"rapid X10 Z20", "rapid X500 Z300", "rapid X10 Z300", "rapid X3 Z300", "end 0"}},
      // X arrives in plus direction by 0.5, Y in minus by 0.25, Z has no side.
      {"single-direction positioning",
       "G60 X10 Y20 Z30\n",
       {"rapid X9.5 Y20.25 Z30", "rapid X10 Y20 Z30", "end 0"}},
      {"single-direction positioning in a frame", "G55 G60 X10\n", {"rapid X109.5", "rapid X110", "end 0"}},
      {"skip move", "G31 L2 G91 X20 F100\n", {"skip2 X20 F100", "end 0"}},
      {"skip input 1 by default", "F50 G31 X20 A5\n", {"skip1 X20 A5 F50", "end 0"}},
      // 10 mm at a lead of 4 and half a turn for the end: 2.5 turns.
      {"lead of a helix counts its turns",
       "G0 X10\nG3 X-10 Z10 I-10 K4 F100\n",
       {"rapid X10", "arc X-10 Z10 ccw 0 0 0 900deg F100", "end 0"}},
      {"a lead beside L says nothing",
       "G0 X10\nG3 X-10 Z10 I-10 K4 L2 F100\n",
       {"rapid X10", "arc X-10 Z10 ccw 0 0 0 540deg F100", "end 0"}},
      {"constant surface speed and back to the speed before",
       "S500\nG96 S120\nS130\nG97\nG97 S600\n",
       {"S500", "S120", "S130", "S500", "S600", "end 0"}},
      {"surface speed in feet", "G20 G96 S100\n", {"S30.48", "end 0"}},
      {"limit of the spindle moves nothing", "G92 S3000\n", {"end 0"}},
  };
  expect_streams(machine, goldens);
}

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
