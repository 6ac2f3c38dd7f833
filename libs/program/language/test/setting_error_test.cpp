// SPDX-License-Identifier: Apache-2.0
// G54.4: words are in the workpiece as it stands, shifted and turned against its drawing, and the tool has
// the direction there that it has in the drawing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

constexpr double to_radians = std::numbers::pi / 180;

Vector3 about(std::size_t axis, double degrees, const Vector3& v) {
  const double c = std::cos(degrees * to_radians), s = std::sin(degrees * to_radians);
  const std::size_t u = (axis + 1) % 3, w = (axis + 2) % 3;
  Vector3 result = v;
  result[u] = c * v[u] - s * v[w];
  result[w] = s * v[u] + c * v[w];
  return result;
}

/// About X, then Y, then Z, as the table has the angles.
Vector3 turned_by(const AxisValues& error, const Vector3& v) {
  return about(2, error[C], about(1, error[B], about(0, error[A], v)));
}

/// Of the tool in the workpiece with the AC table: the table turns by A about -X and by C about -Z, so it is
/// Rz(C) Rx(A) (0, 0, 1).
Vector3 tool_at(const AxisValues& axes) { return about(2, axes[C], about(0, axes[A], {0, 0, 1})); }

const AxisValues error{1, 2, 3, 1, -2, 3, 0, 0, 0};
const AxisValues zero{100, 200, 300, 0, 0, 0, 0, 0, 0};

TestMachine machine_with_error() {
  TestMachine machine;
  machine.offsets[0] = zero;
  machine.setting_errors[1] = error;
  machine.setting_errors[2] = {0, 0, 0, 0, 0, 90, 0, 0, 0};
  machine.setting_errors[3] = {0, 0, 0, 90, 0, 0, 0, 0, 0};
  machine.lengths = {{1, 50.0}};
  return machine;
}

TestMachine three_axes() {
  TestMachine machine = machine_with_error();
  machine.axis_mask = 0b111;
  return machine;
}

void expect_vector(const Vector3& actual, const Vector3& expected, double within = 1e-9) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], within) << i;
}

Vector3 place_of(const Command& command) { return {command.target[X], command.target[Y], command.target[Z]}; }

/// Where `point` of the drawing is.
Vector3 expected_place(const Vector3& point) {
  const Vector3 turned = turned_by(error, point);
  return {zero[X] + error[X] + turned[0], zero[Y] + error[Y] + turned[1], zero[Z] + error[Z] + turned[2]};
}

TEST(SettingError, ShiftsAndTurnsPositions) {
  TestMachine machine = three_axes();
  const auto result = run(machine, "G54.4 P1\nG1 X10 Y-20 Z30 F100\nG91 X5\nG52 X1\nG90 X0 Y0 Z0\nM30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  expect_vector(place_of(result.commands[0]), expected_place({10, -20, 30}));
  expect_vector(place_of(result.commands[1]), expected_place({15, -20, 30}));
  // What G52 shifts stands as the workpiece does.
  expect_vector(place_of(result.commands[2]), expected_place({1, 0, 0}));
}

TEST(SettingError, CanBeUndoneWithEveryOtherFrame) {
  ProgramFrame frame;
  frame.set_work_offset({5, -6, 7, 10, 0, 20, 0, 0, 0});
  frame.set_local(X, 3);
  frame.set_shift(Z, -4);
  frame.set_mirror(Y, true, 2);
  frame.set_rotation(Plane::zx, {1, 2, 3}, 25);
  // A turn about (1, 1, 1) by 120 degrees exchanges the axes.
  frame.set_tilt({true, {9, 8, 7}, {0, 0, 1, 1, 0, 0, 0, 1, 0}});
  frame.set_setting_error(1, error);
  const AxisValues point{11, -12, 13, 30, 0, -40, 0, 0, 0};
  const AxisValues command = frame.command_from_contour(frame.contour_from_program(point));
  const AxisValues back = frame.program_from_command(command);
  for (std::size_t axis = 0; axis < axis_count; ++axis) EXPECT_NEAR(back[axis], point[axis], 1e-12) << axis;
  expect_vector(frame.turned_back(frame.turned({0.6, 0, 0.8})), {0.6, 0, 0.8}, 1e-15);
  // Without it nothing of it is left.
  frame.set_setting_error(0, error);
  EXPECT_EQ(frame.setting_error().matrix, no_rotation);
}

TEST(SettingError, CirclesLieInThePlaneAsItStands) {
  TestMachine machine = three_axes();
  // A quarter about Z keeps the plane; one about X stands it up: its third axis is -Y.
  const auto flat = run(machine, "G54.4 P2\nG0 X10 Y0\nG3 X0 Y10 I-10 F100\nM30\n");
  ASSERT_EQ(flat.last, Step::end) << flat.alarm.text.data();
  ASSERT_EQ(flat.commands[1].kind, CommandKind::arc);
  expect_vector(place_of(flat.commands[1]), {100 - 10, 200, 0});
  EXPECT_NEAR(flat.commands[1].arc.centre[0], 100, 1e-9);
  EXPECT_NEAR(flat.commands[1].arc.centre[1], 200, 1e-9);
  expect_vector(flat.commands[1].arc.normal, {0, 0, 1});
  const auto upright = run(machine, "G54.4 P3\nG0 X10 Y0 Z0\nG3 X0 Y10 I-10 F100\nM30\n");
  ASSERT_EQ(upright.last, Step::end) << upright.alarm.text.data();
  expect_vector(place_of(upright.commands[1]), {100, 200, 310});
  expect_vector(upright.commands[1].arc.normal, {0, -1, 0});
}

// Tip and direction, for any angles away from the pole; there a table turns far for a small direction.
TEST(SettingError, TurnsTheToolAsTheWorkpieceStands) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> place(-200, 200), tilt(15, 80), turn(-170, 170);
  for (int i = 0; i < 300; ++i) {
    TestMachine machine = machine_with_error();
    const auto number = [&](auto& distribution) { return std::round(distribution(random) * 1e3) / 1e3; };
    const double x = number(place), y = number(place), z = number(place), c = number(turn);
    const double a = (i % 2 == 0 ? 1 : -1) * number(tilt);
    char text[160];
    std::snprintf(text, sizeof text, "G54.4 P1\nG43.4 H1\nG1 X%.3f Y%.3f Z%.3f A%.3f C%.3f F100\nM30\n", x, y,
                  z, a, c);
    const auto result = run(machine, text);
    ASSERT_EQ(result.last, Step::end) << text << result.alarm.text.data();
    const Command& move = result.commands[1];
    ASSERT_EQ(move.kind, CommandKind::line);
    expect_vector(place_of(move), expected_place({x, y, z}));
    const Vector3 drawn = about(2, c, about(0, a, {0, 0, 1}));
    expect_vector(tool_at(move.target), turned_by(error, drawn));
    // Of the two solutions that near the words: within the error of 3.8 degrees, divided by the sine of A.
    EXPECT_LT(std::abs(move.target[A] - a), 4) << text;
    EXPECT_LT(std::abs(move.target[C] - c), 20) << text;
  }
}

TEST(SettingError, TheNextMoveTurnsTheToolAndWordsCountOnAsBefore) {
  TestMachine machine = machine_with_error();
  const auto result =
      run(machine,
          "G43.4 H1\nG1 X0 Y0 Z0 A30 C40 F100\nG54.4 P1\nX5\nG91 C10\nG54.4 P0\nG90 X0 Y0 Z0 A30 C40\n"
          "M30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  const auto& c = result.commands;  // frame, line, line, line, line, end
  ASSERT_EQ(c.size(), 6u);
  expect_vector(tool_at(c[2].target), turned_by(error, about(2, 40, about(0, 30, {0, 0, 1}))));
  expect_vector(tool_at(c[3].target), turned_by(error, about(2, 50, about(0, 30, {0, 0, 1}))));
  expect_vector(tool_at(c[4].target), about(2, 40, about(0, 30, {0, 0, 1})));
  expect_vector(place_of(c[4]), {zero[X], zero[Y], zero[Z]});
}

TEST(SettingError, TurnsToolVectorsAndTiltedPlanes) {
  TestMachine machine = machine_with_error();
  const auto vector = run(machine, "G54.4 P1\nG43.5 H1\nG1 X10 Y0 Z0 I3 J0 K4 F100\nM30\n");
  ASSERT_EQ(vector.last, Step::end) << vector.alarm.text.data();
  const Command& led = vector.commands[vector.commands.size() - 2];
  expect_vector(tool_at(led.target), turned_by(error, {0.6, 0, 0.8}));
  expect_vector(place_of(led), expected_place({10, 0, 0}));

  // The plane's axes, after I90 and J30: X is +Y of the workpiece, Z is (sin 30, 0, cos 30).
  const auto plane =
      run(machine, "G54.4 P1\nG43.4 H1\nG68.2 X1 Y2 Z3 I90 J30 K0\nG53.2\nG0 X10 Y0 Z0\nM30\n");
  ASSERT_EQ(plane.last, Step::end) << plane.alarm.text.data();
  const Command& moved = plane.commands[plane.commands.size() - 2];
  expect_vector(place_of(moved), expected_place({1, 12, 3}));
  expect_vector(tool_at(moved.target), turned_by(error, {0.5, 0, std::sqrt(0.75)}));
}

TEST(SettingError, WithoutToolTipControlTheTableMustBeAtZero) {
  TestMachine machine = machine_with_error();
  const auto straight = run(machine, "G54.4 P1\nG0 X10 Y0 Z0\nM30\n");
  ASSERT_EQ(straight.last, Step::end) << straight.alarm.text.data();
  expect_vector(place_of(straight.commands[0]), expected_place({10, 0, 0}));
  for (const char* program :
       {"G54.4 P1\nG0 X10 A5\n", "G0 C90\nG54.4 P1\nG0 X10\n", "G54.4 P1\nG68.2 X0 Y0 Z0 I0 J10 K0\n",
        "G68.2 X0 Y0 Z0 I0 J10 K0\nG53.1\nG54.4 P1\n"}) {
    const auto result = run(machine, program);
    EXPECT_EQ(result.alarm.number, AlarmNumber::tip_control_needed) << program;
  }
}

TEST(SettingError, ADirectionOutOfReachIsAnAlarm) {
  TestMachine machine = machine_with_error();
  // A goes to 98 degrees. Turned by 90 about X the tool of A95, C0 would point down: A185.
  const auto result = run(machine, "G54.4 P3\nG43.4 H1\nG1 X0 A95 F100\n");
  EXPECT_EQ(result.alarm.number, AlarmNumber::orientation_impossible);
  EXPECT_EQ(result.alarm.line, 3u);
  EXPECT_EQ(result.commands.size(), 1u) << "nothing of the block moves";
}

TEST(SettingError, ProgramsChangeTheTable) {
  TestMachine machine = three_axes();
  EXPECT_THAT(
      stream(run(machine,
                 "G54.4 P2\nG10 L23 P2 X1 C0\nG91 G10 L23 P2 X1 C180\nG90 G0 X10 Y0 Z0\n"
                 "G20 G10 L23 P7 Z1\nM30\n")),
      // Turned by 180 about Z, 2 beside the zero.
      ElementsAre("table1 56 X1", "table1 56 X2 C180", "rapid X92 Y200 Z300", "table1 61 Z25.4", "end 30"));
}

TEST(SettingError, ALineOfManualDataInputFindsItWithTheTableAsItIs) {
  TestMachine machine = three_axes();
  Interpreter interpreter(machine);
  const auto target = [&](const std::string& text, Beginning beginning) {
    StringSource source(text);
    interpreter.start(source, interpreter.position(), interpreter.modal(), no_variables, beginning);
    Command command;
    EXPECT_EQ(interpreter.next(command), Step::command) << interpreter.alarm().text.data();
    return place_of(command);
  };
  expect_vector(target("G54.4 P2 G0 X10 Y0 Z0\n", Beginning::program), {100, 210, 300});
  machine.setting_errors[2] = {0, 0, 0, 0, 0, 180, 0, 0, 0};
  expect_vector(target("X20 Y0\n", Beginning::line), {80, 200, 300});
  expect_vector(target("G0 X20\n", Beginning::program), {120, 200, 300});
}

}  // namespace
}  // namespace trunnion::language::test
