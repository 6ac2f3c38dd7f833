// SPDX-License-Identifier: Apache-2.0
// Tilted planes, the swing to them, and tool vectors, on the AC table of the test machine.
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_with_tool() {
  TestMachine machine;
  machine.lengths = {{1, 120.0}};
  machine.offsets[0] = {-150, -100, -400, 0, 0, 0, 0, 0, 0};
  machine.tools[2] = {0, 0, 5, 0};
  return machine;
}

/// Where the tool points in the workpiece frame: from the tip of a tool of length 1 to that of one of length
/// 0.
Vector3 tool_direction(const TestMachine& machine, const AxisValues& machine_position) {
  const AxisValues tip = machine.tip_from_machine(machine_position, 1);
  const AxisValues gauge = machine.tip_from_machine(machine_position, 0);
  return {gauge[X] - tip[X], gauge[Y] - tip[Y], gauge[Z] - tip[Z]};
}

void expect_vector_near(const Vector3& a, const Vector3& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

void expect_point(const AxisValues& target, const Vector3& point) {
  expect_vector_near({target[X], target[Y], target[Z]}, point, 1e-9);
}

// The example of the manual: I90 J45 K-90 turns by 45 degrees about Y.
constexpr double half = 0.7071067811865476;  // sine and cosine of 45 degrees
const std::string tilted = "G43.4 H1\nG68.2 X30 Y-40 Z0 I90 J45 K-90\n";

TEST(Tilt, EulerAnglesOfTheManualAndSwingWithTheTipHeld) {
  TestMachine machine = machine_with_tool();
  const Interpretation result =
      run(machine, "G0 X5 Y6 Z200\n" + tilted + "G53.2\nG01 X0 Y-15 Z0 F2000\nG69\nX0\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  using enum CommandKind;
  const CommandKind kinds[] = {rapid, transformation, transformation, line, line, transformation, line, end};
  ASSERT_EQ(result.commands.size(), std::size(kinds));
  for (std::size_t i = 0; i < std::size(kinds); ++i) EXPECT_EQ(result.commands[i].kind, kinds[i]) << i;
  // Tilting moves nothing.
  EXPECT_EQ(result.commands[2].target, result.commands[1].target);
  EXPECT_TRUE(result.commands[2].modal.tilt.active);
  expect_vector_near(result.commands[2].modal.tilt.origin, {30, -40, 0}, 0);
  // The swing holds the tip and points the tool along the plane's Z, (sin 45, 0, cos 45).
  const AxisValues& swung = result.commands[3].target;
  for (const Axis axis : {X, Y, Z}) EXPECT_EQ(swung[axis], result.commands[2].target[axis]);
  EXPECT_EQ(result.commands[3].modal.feed, 1000);
  expect_vector_near(tool_direction(machine, machine.machine_from_tip(swung, 120)), {half, 0, half}, 1e-9);
  // (0, -15, 0) of the plane is the origin moved along Y: workpiece (30, -55, 0), over G54.
  expect_point(result.commands[4].target, {30 - 150, -55 - 100, 0 - 400});
  EXPECT_EQ(result.commands[4].modal.feed, 2000);
  // Without the plane X0 is the workpiece's.
  expect_point(result.commands[6].target, {0 - 150, -55 - 100, 0 - 400});
}

TEST(Tilt, SwingOfTheRotaryAxesAlone) {
  TestMachine machine = machine_with_tool();
  const Interpretation result = run(machine, "G0 X5 Y6 Z200\nF300\n" + tilted + "G53.1\nG1 X1\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  ASSERT_EQ(result.commands.size(), 8u);
  // The move is one in machine coordinates, and only its rotary axes change.
  const Command& before = result.commands[3];
  const Command& swing = result.commands[4];
  const Command& after = result.commands[5];
  EXPECT_EQ(before.kind, CommandKind::transformation);
  EXPECT_EQ(before.modal.transformation, Transformation::none);
  EXPECT_EQ(swing.kind, CommandKind::line);
  EXPECT_EQ(swing.modal.feed, 300);
  for (const Axis axis : {X, Y, Z}) EXPECT_EQ(swing.target[axis], before.target[axis]);
  EXPECT_EQ(swing.target, AxisValues({-145, -94, -200, swing.target[A], 0, swing.target[C], 0, 0, 0}));
  expect_vector_near(tool_direction(machine, swing.target), {half, 0, half}, 1e-9);
  EXPECT_EQ(after.modal.transformation, Transformation::rtcp);
  const AxisValues tip = machine.tip_from_machine(swing.target, 120);
  for (const Axis axis : {X, Y, Z}) EXPECT_NEAR(after.target[axis], tip[axis], 1e-9);
}

TEST(Tilt, SpatialAnglesTurnAboutFixedAxesXThenYThenZ) {
  TestMachine machine = machine_with_tool();
  // X1 is not changed about X, and becomes Y1 about Z; Y1 becomes Z1 about X and stays.
  const Interpretation result =
      run(machine, "G43.4 H1\nG68.3 X0 Y0 Z0 I90 J0 K90\nG53.2\nG0 X1 Y0 Z0\nX0 Y1\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  expect_point(result.commands[3].target, {-150, -99, -400});
  expect_point(result.commands[4].target, {-150, -100, -399});
}

// I90 makes X the Y of the workpiece and Y its -X. In that plane the new one is at 1 Y - 2 X + 3 Z from the
// origin, and J90 about its X takes its Y to Z and its Z to -Y, which is +X of the workpiece.
TEST(Tilt, AFurtherPlaneBeginsAtTheAxesOfTheOneBefore) {
  for (const char* swing : {"", "G53.2\n"}) {
    TestMachine machine = machine_with_tool();
    const Interpretation result =
        run(machine, std::string("G43.4 H1\nG68.2 X10 Y20 Z30 I90 J0 K0\n") + swing +
                         "G68.4 X1 Y2 Z3 I0 J90 K0\nG53.6\nG0 X0 Y0 Z0\nX1\nX0 Y1\nG69\nG0 X0\n");
    ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
    const auto& c = result.commands;
    // The last five: three moves, the frame of G69, a move, the end.
    const std::size_t first = c.size() - 6;
    const Vector3 origin{10 - 2 - 150, 20 + 1 - 100, 30 + 3 - 400};
    expect_point(c[first].target, origin);
    expect_point(c[first + 1].target, {origin[0], origin[1] + 1, origin[2]});
    expect_point(c[first + 2].target, {origin[0], origin[1], origin[2] + 1});
    expect_vector_near(tool_direction(machine, machine.machine_from_tip(c[first].target, 120)), {1, 0, 0},
                       1e-9);
    EXPECT_NEAR(c[first + 4].target[X], -150, 1e-9) << "G69 ends both";
  }
}

TEST(Tilt, ThreePoints) {
  TestMachine machine = machine_with_tool();
  // X along (0, 1, 0) and Y along (0, 0, 1), so Z along (1, 0, 0).
  machine.planes[7] = {{{1, 2, 3}, {1, 12, 3}, {1, 5, 9}}};
  const Interpretation result = run(machine, "G43.4 H1\nG68.1 Q7\nG53.2\nG0 X10 Y20 Z30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  expect_point(result.commands[3].target, {1 + 30 - 150, 2 + 10 - 100, 3 + 20 - 400});
}

TEST(Tilt, ChoiceOfTheRotarySolution) {
  TestMachine machine = machine_with_tool();
  for (const int choice : {0, 1, 2}) {
    const Interpretation result =
        run(machine, "G43.4 H1\nG68.2 X0 Y0 Z0 I30 J20 K0 P" + std::to_string(choice) + "\nG53.2\n");
    ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
    const double c = result.commands[2].target[C];
    EXPECT_NE(c, 0);
    EXPECT_TRUE(choice == 0 || (c > 0) == (choice == 1)) << choice << " " << c;
    EXPECT_EQ(result.commands[2].kind, CommandKind::line);
  }
}

TEST(Tilt, CirclesLieInThePlane) {
  TestMachine machine = machine_with_tool();
  const Interpretation result =
      run(machine, tilted + "G53.2\nG0 X10 Y0 Z0\nG3 X0 Y10 I-10 F100\nG18 G2 X0 Z-10 Y10 K-5\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  const Command& arc = result.commands[4];
  ASSERT_EQ(arc.kind, CommandKind::arc);
  expect_vector_near(arc.arc.centre, {30 - 150, -40 - 100, -400}, 1e-9);
  expect_vector_near(arc.arc.normal, {half, 0, half}, 1e-12);
  EXPECT_FALSE(arc.arc.clockwise);
  EXPECT_NEAR(arc.arc.sweep, 90, 1e-9);
  // ZX: the plane's Y is the workpiece's.
  expect_vector_near(result.commands[5].arc.normal, {0, 1, 0}, 1e-12);
  expect_vector_near(result.commands[5].arc.centre, {30 - 5 * half - 150, -40 + 10 - 100, -5 * half - 400},
                     1e-9);
}

TEST(Tilt, CutterCompensationWorksInThePlane) {
  TestMachine machine = machine_with_tool();
  const Interpretation result =
      run(machine, tilted + "G53.2\nG0 X0 Y0 Z0\nG41 D2 G1 X10 F100\nX30\nY20\nG40 X0\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  // (25, 5, 0) of the plane: X goes along (cos 45, 0, -sin 45).
  expect_point(result.commands[5].target, {30 + 25 * half - 150, -40 + 5 - 100, -25 * half - 400});
}

TEST(Tilt, MoveAlongTheTool) {
  TestMachine machine = machine_with_tool();
  const Interpretation result = run(machine, tilted + "G53.2\nG53.3 L10 F100\nG53.3 L-4\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  const AxisValues& from = result.commands[2].target;
  const AxisValues& out = result.commands[3].target;
  const AxisValues& in = result.commands[4].target;
  expect_vector_near({out[X] - from[X], out[Y] - from[Y], out[Z] - from[Z]}, {10 * half, 0, 10 * half}, 1e-9);
  expect_vector_near({in[X] - from[X], in[Y] - from[Y], in[Z] - from[Z]}, {6 * half, 0, 6 * half}, 1e-9);
}

TEST(ToolVector, IsMadeRotaryAngles) {
  TestMachine machine = machine_with_tool();
  machine.offsets[0][C] = 5;  // angles of vectors know no offset: the direction is the workpiece's
  const Interpretation result = run(machine, "G43.5 H1\nG1 X1 I1 J0 K1 F100\nI0 K2\nX2\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  ASSERT_EQ(result.commands.size(), 5u);
  EXPECT_TRUE(result.commands[1].modal.tool_vector);
  const AxisValues& leaning = result.commands[1].target;
  expect_vector_near(tool_direction(machine, machine.machine_from_tip(leaning, 120)), {half, 0, half}, 1e-9);
  const AxisValues& upright = result.commands[2].target;
  EXPECT_EQ(upright[X], leaning[X]);
  expect_vector_near(tool_direction(machine, machine.machine_from_tip(upright, 120)), {0, 0, 1}, 1e-9);
  for (const Axis axis : {A, C}) EXPECT_NEAR(result.commands[3].target[axis], upright[axis], 1e-12);
}

}  // namespace
}  // namespace trunnion::language::test
