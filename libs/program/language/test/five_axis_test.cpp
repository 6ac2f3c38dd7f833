// SPDX-License-Identifier: Apache-2.0
// Tool tip control on the AC table of the test machine.
#include <gtest/gtest.h>

#include <random>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_with_tools() {
  TestMachine machine;
  machine.lengths = {{1, 120.0}, {2, 75.5}};
  machine.offsets[0] = {-150, -100, -400, 0, 0, 0, 0, 0, 0};
  return machine;
}

void expect_near(const AxisValues& a, const AxisValues& b, double tolerance) {
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    EXPECT_NEAR(a[axis], b[axis], tolerance) << axis_letters[axis];
}

TEST(FiveAxis, TestMachineAgreesWithItselfAndWithAHandWorkedPose) {
  const TestMachine machine = machine_with_tools();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> value(-500, 500);
  for (int i = 0; i < 1000; ++i) {
    AxisValues tip{};
    for (double& component : tip) component = value(random);
    expect_near(machine.tip_from_machine(machine.machine_from_tip(tip, 100), 100), tip, 1e-9);
  }
  // C axis (0,0,-1) by 90 degrees takes the point at (Xc + 10, Yc) to (Xc, Yc - 10).
  const AxisValues turned =
      machine.machine_from_tip({machine.centre[0] + 10, machine.centre[1], 0, 0, 0, 90, 0, 0, 0}, 0);
  EXPECT_NEAR(turned[X], machine.centre[0], 1e-9);
  EXPECT_NEAR(turned[Y], machine.centre[1] - 10, 1e-9);
}

TEST(FiveAxis, WithRotaryAxesAtZeroTheFrameIsMachineMinusToolLength) {
  TestMachine machine = machine_with_tools();
  const Interpretation result = run(machine, "G0 X1 Y2 Z3\nG43.4 H1\nG0 X1 Y2 Z50\n");
  ASSERT_EQ(result.last, Step::end);
  EXPECT_EQ(result.commands[1].kind, CommandKind::transformation);
  expect_near(result.commands[1].target, {-149, -98, -397 - 120, 0, 0, 0, 0, 0, 0}, 1e-9);
  // Z50 is the tip's height over the work offset, without the tool length.
  expect_near(result.commands[2].target, {-149, -98, -350, 0, 0, 0, 0, 0, 0}, 1e-9);
}

TEST(FiveAxis, SwitchingOnAndOffDoesNotMoveTheMachine) {
  TestMachine machine = machine_with_tools();
  const Interpretation result =
      run(machine, "G43 H2 G0 X1 Y2 Z3 A-35 C140\nG43.4 H1\nG43.4 H2\nG43 H1\nG49\n");
  ASSERT_EQ(result.last, Step::end);
  ASSERT_EQ(result.commands.size(), 7u);  // length, rapid, four changes, end
  const AxisValues machine_position = result.commands[1].target;
  const AxisValues& long_tool = result.commands[2].target;
  EXPECT_EQ(result.commands[2].modal.transformation, Transformation::rtcp);
  EXPECT_EQ(result.commands[2].modal.tool_length, 120);
  expect_near(machine.machine_from_tip(long_tool, 120), machine_position, 1e-9);
  const AxisValues& short_tool = result.commands[3].target;
  EXPECT_EQ(result.commands[3].modal.tool_length, 75.5);
  expect_near(machine.machine_from_tip(short_tool, 75.5), machine_position, 1e-9);
  EXPECT_EQ(result.commands[4].modal.transformation, Transformation::none);
  expect_near(result.commands[4].target, machine_position, 1e-9);
  expect_near(result.commands[5].target, machine_position, 1e-9);
  EXPECT_EQ(result.commands[5].modal.length_offset, 0);
}

TEST(FiveAxis, RotaryMoveHoldsTheTipInItsFrame) {
  TestMachine machine = machine_with_tools();
  const Interpretation result = run(machine, "G43.4 H1\nG0 X10 Y20 Z30\nG1 A-30 C90 F500\nX11\n");
  ASSERT_EQ(result.last, Step::end);
  const AxisValues& before = result.commands[1].target;
  const AxisValues& turned = result.commands[2].target;
  for (const Axis axis : {X, Y, Z}) EXPECT_EQ(turned[axis], before[axis]);
  EXPECT_EQ(turned[A], -30);
  EXPECT_EQ(turned[C], 90);
  EXPECT_EQ(result.commands[3].target[X], before[X] + 1);
}

TEST(FiveAxis, TestProgramOfTheSimultaneousMotionCheck) {
  TestMachine machine = machine_with_tools();
  const Interpretation result =
      run(machine,
          "%12345; RTCP\nG54 X10 Y20 Z150 F3000\nG01 C0\nG43.4 H1\nM00\nG91 C360\nM00\n"
          "G90 G01 C0\nM30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  using enum CommandKind;
  const CommandKind kinds[] = {rapid, transformation, auxiliary, line, auxiliary, line, end};
  ASSERT_EQ(result.commands.size(), std::size(kinds));
  for (std::size_t i = 0; i < std::size(kinds); ++i) EXPECT_EQ(result.commands[i].kind, kinds[i]) << i;
  // The tip stays where it is in the turning frame: over the offset (-150, -100, -400) and a tool of 120.
  for (const std::size_t i : {3u, 5u}) {
    EXPECT_NEAR(result.commands[i].target[X], -140, 1e-9);
    EXPECT_NEAR(result.commands[i].target[Y], -80, 1e-9);
    EXPECT_NEAR(result.commands[i].target[Z], -250 - 120, 1e-9);
  }
  EXPECT_EQ(result.commands[3].target[C], 360);
  EXPECT_EQ(result.commands[5].target[C], 0);
}

TEST(FiveAxis, ArcsAreInTheTipFrame) {
  TestMachine machine = machine_with_tools();
  const Interpretation result = run(machine, "G43.4 H1\nG0 X10 Y0 Z0\nG3 X0 Y10 I-10 A-20 C40 F500\n");
  ASSERT_EQ(result.last, Step::end);
  const Command& arc = result.commands[2];
  EXPECT_NEAR(arc.arc.centre[0], -150, 1e-9);
  EXPECT_NEAR(arc.arc.centre[1], -100, 1e-9);
  EXPECT_NEAR(arc.arc.centre[2], -400, 1e-9);
  EXPECT_NEAR(arc.arc.sweep, 90, 1e-9);
  EXPECT_EQ(arc.target[C], 40);
}

TEST(FiveAxis, ProgramMayStartInTheTipFrame) {
  TestMachine machine = machine_with_tools();
  const Interpretation first = run(machine, "G43.4 H1 G0 X5 A-10 C30\n");
  const Interpretation second = run(machine, "G91 X1\nG49\n", first.commands.back().target, first.modal);
  ASSERT_EQ(second.commands.size(), 3u);
  AxisValues tip = first.commands.back().target;
  tip[X] += 1;
  expect_near(second.commands[0].target, tip, 1e-12);
  expect_near(second.commands[1].target, machine.machine_from_tip(tip, 120), 1e-9);
}

}  // namespace
}  // namespace trunnion::language::test
