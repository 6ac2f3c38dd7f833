// SPDX-License-Identifier: Apache-2.0
// Lines with ,A: one coordinate and the angle, or two angles and the end of the second line.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

Interpretation run_drawn(const std::string& text, TestMachine machine = {}) {
  machine.tools[1] = {0, 0, 5, 0};
  Interpretation result = run(machine, text);
  EXPECT_EQ(result.last, Step::end) << text << result.alarm.text.data();
  return result;
}

void expect_at(const Command& command, double x, double y, double z = 0) {
  EXPECT_NEAR(command.target[X], x, 1e-9);
  EXPECT_NEAR(command.target[Y], y, 1e-9);
  EXPECT_NEAR(command.target[Z], z, 1e-9);
}

TEST(DrawnLine, OneCoordinateAndTheAngleGiveTheOther) {
  const auto result = run_drawn("G1 X20 ,A30 F100\nG91 Y5 ,A90\nX-10 ,A180\nG90 X0 ,A-135\nM30\n");
  ASSERT_EQ(result.commands.size(), 5u);
  const double y = 20 * std::tan(30 * degree);
  expect_at(result.commands[0], 20, y);
  // Quarter turns are exact.
  expect_at(result.commands[1], 20, y + 5);
  EXPECT_EQ(result.commands[1].target[X], 20);
  expect_at(result.commands[2], 10, y + 5);
  EXPECT_EQ(result.commands[2].target[Y], result.commands[1].target[Y]);
  // -135 degrees is the line of 45: 10 back in both.
  expect_at(result.commands[3], 0, y - 5);
}

// In ZX the angle counts from Z towards X, and X of a diameter is half of it.
TEST(DrawnLine, CountsFromTheFirstAxisOfThePlane) {
  expect_at(run_drawn("G18 G1 X10 ,A30 F100\nM30\n").commands[0], 10, 0, 10 / std::tan(30 * degree));
  expect_at(run_drawn("G19 G1 Y10 ,A30 F100\nM30\n").commands[0], 0, 10, 10 * std::tan(30 * degree));
  TestMachine lathe;
  lathe.diameter = true;
  expect_at(run_drawn("G18 G1 X10 ,A30 F100\nM30\n", std::move(lathe)).commands[0], 5, 0,
            5 / std::tan(30 * degree));
}

TEST(DrawnLine, OtherAxesGoAlong) {
  const auto result = run_drawn("G1 X20 Z-3 ,A45 C9 F100\nM30\n");
  expect_at(result.commands[0], 20, 20, -3);
  EXPECT_NEAR(result.commands[0].target[C], 9, 1e-12);
}

TEST(DrawnLine, IsInTheFrameOfTheProgram) {
  // Turned by a quarter, +X of the program is +Y.
  expect_at(run_drawn("G68 X0 Y0 R90\nG1 X10 ,A45 F100\nM30\n").commands[0], -10, 10);
  expect_at(run_drawn("G51.1 X0\nG1 X10 ,A45 F100\nM30\n").commands[0], -10, 10);
  expect_at(run_drawn("G20 G1 X1 ,A45 F10\nM30\n").commands[0], 25.4, 25.4);
}

// y = x tan 30 and y = 40 - x.
TEST(DrawnLine, TwoAnglesGiveTheCornerOfTwoLines) {
  const auto result = run_drawn("F100 G1\n,A30\n(between)\n#1=7\nX40 Y0 ,A135 F200\nX50\nM30\n");
  ASSERT_EQ(result.commands.size(), 4u);
  const double x = 40 / (1 + std::tan(30 * degree));
  expect_at(result.commands[0], x, 40 - x);
  expect_at(result.commands[1], 40, 0);
  expect_at(result.commands[2], 50, 0);
  EXPECT_EQ(result.commands[0].line, 2u) << "a search and a restart find it at its own block";
  EXPECT_EQ(result.commands[1].line, 5u);
  EXPECT_EQ(result.commands[0].modal.feed, 100);
  EXPECT_EQ(result.commands[1].modal.feed, 200);
  EXPECT_EQ(result.commands[2].modal.feed, 200);
  for (std::size_t i = 0; i < result.commands.size(); ++i) EXPECT_EQ(result.commands[i].sequence, i + 1);
}

TEST(DrawnLine, ChainsOfThemHaveTheirCorners) {
  // A corner before, one of 3 mm at the meeting (30, 0) of the two lines, one behind.
  const auto result = run_drawn("G1 X10 ,C1 F100\n,A0 ,R3\nX30 Y20 ,A90 ,C2\nX0 ,A180\nM30\n");
  ASSERT_EQ(result.commands.size(), 8u);
  expect_at(result.commands[0], 9, 0);
  // Straight on there is nothing to cut off but the chamfer's own way.
  expect_at(result.commands[1], 11, 0);
  expect_at(result.commands[2], 27, 0);
  ASSERT_EQ(result.commands[3].kind, CommandKind::arc);
  expect_at(result.commands[3], 30, 3);
  EXPECT_NEAR(result.commands[3].arc.centre[0], 27, 1e-9);
  EXPECT_NEAR(result.commands[3].arc.centre[1], 3, 1e-9);
  EXPECT_EQ(result.commands[3].line, 2u);
  expect_at(result.commands[4], 30, 18);
  expect_at(result.commands[5], 28, 20);
  expect_at(result.commands[6], 0, 20);
}

// With the radius 5 to the left of the contour the corner (50, 0) becomes (45, 5).
TEST(DrawnLine, TheCompensationSeesTheLinesAsDrawn) {
  const auto result = run_drawn("G41 D1 G1 X0 Y0 F100\nX10\n,A0\nX50 Y30 ,A90\nG40 X80 Y80\nM30\n");
  bool seen = false;
  for (const Command& command : result.commands)
    seen = seen || (std::abs(command.target[X] - 45) < 1e-9 && std::abs(command.target[Y] - 5) < 1e-9);
  EXPECT_TRUE(seen);
}

// The inclinations of both moves are those of the words, whatever the lines.
TEST(DrawnLine, RandomLinesHaveTheirAngles) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-100, 100), angle(-360, 360);
  const auto inclination = [](const AxisValues& from, const AxisValues& to) {
    return std::atan2(to[Y] - from[Y], to[X] - from[X]) / degree;
  };
  int checked = 0;
  for (int i = 0; i < 1000; ++i) {
    const double a = std::round(angle(random)), b = std::round(angle(random));
    const double x = std::round(place(random)), y = std::round(place(random));
    const double between = std::abs(std::remainder(a - b, 180.0));
    if (between < 1) continue;
    char text[120];
    std::snprintf(text, sizeof text, "G1 X1 Y2 F100\n,A%.0f\nX%.0f Y%.0f ,A%.0f\nM30\n", a, x, y, b);
    const auto result = run_drawn(text);
    if (result.commands.size() != 4) continue;  // a line without length is no move
    ++checked;
    const auto& c = result.commands;
    // The corner is at most some 1e4 mm away, where 1e-10 mm is 1e-8 degrees of the shortest line of 1e-2.
    const double first = std::hypot(c[1].target[X] - 1, c[1].target[Y] - 2);
    const double second = std::hypot(c[2].target[X] - c[1].target[X], c[2].target[Y] - c[1].target[Y]);
    if (first < 1e-2 || second < 1e-2) continue;
    EXPECT_NEAR(std::remainder(inclination(c[0].target, c[1].target) - a, 180.0), 0, 1e-6) << text;
    EXPECT_NEAR(std::remainder(inclination(c[1].target, c[2].target) - b, 180.0), 0, 1e-6) << text;
    expect_at(c[2], x, y);
  }
  EXPECT_GT(checked, 900);
}

TEST(DrawnLine, ARedundantAngleMustAgreeWithTheEnd) {
  expect_at(run_drawn("G1 X20 Y20 ,A45 F100\nM30\n").commands[0], 20, 20);
  // 0.1 mm is allowed, as at the ends of circles.
  expect_at(run_drawn("G1 X20 Y11.547 ,A30 F100\nM30\n").commands[0], 20, 11.547);
}

TEST(DrawnLine, WhatIsNotDeterminedIsAnAlarm) {
  using enum AlarmNumber;
  struct Case {
    const char* text;
    AlarmNumber number;
    const char* says;
  };
  const Case cases[] = {
      {"G1 X20 ,A90 F100\n", angle_undetermined, ",A90, it never reaches the coordinate"},
      {"G1 Y20 ,A180 F100\n", angle_undetermined, ",A180, it never reaches the coordinate"},
      {"G1 X20 Y20 ,A30 F100\n", angle_undetermined, ",A30, it does not pass through the end"},
      {"G1 Z5 ,A30 F100\n", angle_undetermined, ",A30, needs a coordinate of the plane"},
      {"G16\nG1 X20 ,A30 F100\n", angle_undetermined, ",A30, not in polar coordinates (G16)"},
      {"G1 ,A30 F100\nX20 Y20 ,A-150\n", angle_undetermined, ",A-150, parallel to the line before"},
      {"G1 ,A30 F100\nX20 Y0\n", angle_open, ": X20"},
      {"G1 ,A30 F100\nX20 ,A90\n", angle_open, ": X20"},
      {"G1 ,A30 F100\nX20 Y0 Z1 ,A90\n", angle_open, ": X20"},
      {"G1 ,A30 F100\nG91 X20 Y0 ,A90\n", angle_open, ": X20"},
      {"G1 ,A30 F100\nG0 X20 Y0\n", angle_open, ": X20"},
      {"G1 ,A30 F100\n,A60\nX20 Y0 ,A90\n", angle_open, ": ,A60"},
      {"G1 ,A30 F100\nG18 X20 Z0 ,A90\n", angle_open, ": X20"},
      {"G1 ,A30 F100\nG68 X0 Y0 R5\nX20 Y0 ,A90\n", angle_open, ": X20"},
      {"G1 ,A30 F100\nM8\nX20 Y0 ,A90\n", angle_open, ": M8"},
      {"G1 ,A30 F100\nG4 P1\nX20 Y0 ,A90\n", angle_open, ": G4"},
      {"G1 ,A30 F100\nM30\n", angle_open, ": M30"},
      {"G1 ,A30 F100\n", angle_open, ""},
      {"G0 X20 ,A30\n", unused_word, ": ,A30"},
      {"G2 X20 R10 ,A30 F100\n", unused_word, ": ,A30"},
      {"G1 X20 ,A30 ,A40 F100\n", letter_twice, ": ,A40"},
      {"G1 ,A30\n", feed_missing, ": ,A30"},
  };
  for (const Case& c : cases) {
    TestMachine machine;
    const auto result = run(machine, c.text);
    EXPECT_EQ(result.last, Step::alarm) << c.text;
    EXPECT_EQ(result.alarm.number, c.number) << c.text << result.alarm.text.data();
    EXPECT_TRUE(std::string(result.alarm.text.data()).ends_with(c.says)) << result.alarm.text.data();
  }
}

// A line of manual data input that leaves a line open is refused, and the next one begins without it.
TEST(DrawnLine, DoesNotWaitForAnotherLineOfManualDataInput) {
  TestMachine machine;
  Interpreter interpreter(machine);
  const auto read = [&](const std::string& text, Beginning beginning) {
    StringSource source(text);
    interpreter.start(source, interpreter.position(), interpreter.modal(), no_variables, beginning);
    Command command;
    Step step = Step::command;
    while (step == Step::command || step == Step::working) step = interpreter.next(command);
    return step;
  };
  EXPECT_EQ(read("G1 X5 F100\n", Beginning::program), Step::end);
  EXPECT_EQ(read(",A30\n", Beginning::line), Step::alarm);
  EXPECT_EQ(interpreter.alarm().number, AlarmNumber::angle_open);
  EXPECT_EQ(read("X20 Y3\n", Beginning::line), Step::end) << interpreter.alarm().text.data();
}

}  // namespace
}  // namespace trunnion::language::test
