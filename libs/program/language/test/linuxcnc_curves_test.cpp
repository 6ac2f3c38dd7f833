// SPDX-License-Identifier: Apache-2.0
// Splines and probing of the LinuxCNC dialect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linuxcnc_program.hpp"

namespace trunnion::language::test {
namespace {

using ::testing::ElementsAre;

using Points = std::vector<std::array<double, 2>>;

/// The ends of the lines of a program that must reach its end.
Points line_ends(const std::string& blocks) {
  TestMachine machine = linuxcnc_machine();
  const Interpretation result = run(machine, blocks + "\nM2\n");
  EXPECT_EQ(result.last, Step::end) << blocks << ": " << result.alarm.text.data();
  Points points;
  for (const Command& command : result.commands)
    if (command.kind == CommandKind::line) points.push_back({command.target[X], command.target[Y]});
  return points;
}

/// Largest distance of the points from a curve of the parameter 0 to 1.
template <class Curve>
double farthest_from(const Points& points, const Curve& curve) {
  constexpr int parts = 20000;
  double farthest = 0;
  for (const auto& point : points) {
    double nearest = 1e9;
    for (int i = 0; i <= parts; ++i) {
      const auto place = curve(static_cast<double>(i) / parts);
      nearest = std::min(nearest, std::hypot(place[0] - point[0], place[1] - point[1]));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(LinuxcncCurves, ACubicSplineIsABezierCurve) {
  // Control points (0, 0), (0, 3), (1, -2), (1, 1).
  const auto bezier = [](double t) {
    const double s = 1 - t;
    return std::array{3 * s * t * t + t * t * t, 9 * s * s * t - 6 * s * t * t + t * t * t};
  };
  const Points points = line_ends("G5 X1 Y1 I0 J3 P0 Q-3 F100");
  ASSERT_GT(points.size(), 10u);
  EXPECT_LT(farthest_from(points, bezier), 1e-3);
  EXPECT_NEAR(points.back()[0], 1, 1e-12);
  EXPECT_NEAR(points.back()[1], 1, 1e-12);
}

TEST(LinuxcncCurves, AFurtherSplineBeginsAsTheOneBeforeEnds) {
  const std::string first = "F100\nG5 X1 Y1 I0 J3 P1 Q-3\n";
  EXPECT_EQ(line_ends(first + "G5 P0 Q-3 X2 Y2"), line_ends(first + "G5 I-1 J3 P0 Q-3 X2 Y2"));
  EXPECT_EQ(line_ends(first + "P0 Q-3 X2 Y2"), line_ends(first + "G5 I-1 J3 P0 Q-3 X2 Y2"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG5 X1 Y1 P1 Q-3"), ElementsAre("alarm 1108 2:1"));
  EXPECT_EQ(linuxcnc_blocks(first + "G1 X2\nG5 P0 Q-3 X3 Y2").back(), "alarm 1108 4:1");
}

TEST(LinuxcncCurves, AQuadraticSplineIsAParabola) {
  const Points points = line_ends("G0 X-2 Y4\nG5.1 X2 I2 J-8 F100");
  ASSERT_GT(points.size(), 4u);
  for (const auto& point : points) EXPECT_NEAR(point[1], point[0] * point[0], 1e-9);
  EXPECT_THAT(linuxcnc_blocks("G5.1 X2 F100"), ElementsAre("alarm 1108 1:1"));
}

TEST(LinuxcncCurves, WeightsMakeACircle) {
  const Points points = line_ends("G0 X1\nG5.2 X1 Y1 P0.70710678118654752 F100\nX0 Y1\nG5.3");
  ASSERT_GT(points.size(), 4u);
  for (const auto& point : points) EXPECT_NEAR(std::hypot(point[0], point[1]), 1, 1e-9);
  EXPECT_NEAR(points.back()[1], 1, 1e-12);
}

TEST(LinuxcncCurves, ANurbsHasEqualSpans) {
  // Of order 3 the spans meet half way between their control points; the last has the weight 2.
  const Points points =
      line_ends("F100\nG5.2 P1 L3\nX0 Y1 P1\n(nothing)\nX2 Y2 P1\nX2 Y0 P1\nX0 Y0 P2\nG5.3");
  const auto passes = [&](double x, double y) {
    return std::any_of(points.begin(), points.end(),
                       [&](const auto& point) { return std::hypot(point[0] - x, point[1] - y) < 1e-9; });
  };
  EXPECT_TRUE(passes(1, 1.5));
  EXPECT_TRUE(passes(2, 1));
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(std::hypot(points.back()[0], points.back()[1]), 0, 1e-12);
}

TEST(LinuxcncCurves, OnlyTheLastChordEndsInACorner) {
  TestMachine machine = linuxcnc_machine();
  for (const char* curve : {"G5 X1 Y1 I0 J3 P0 Q-3 F100", "G5.2 X1 Y1 F100\nX2 Y0\nX3 Y3\nX4 Y0\nG5.3"}) {
    const Interpretation result = run(machine, std::string(curve) + "\nM2\n");
    ASSERT_GT(result.commands.size(), 4u) << curve;
    for (std::size_t i = 0; i + 2 < result.commands.size(); ++i) EXPECT_TRUE(result.commands[i].chord) << i;
    EXPECT_FALSE(result.commands[result.commands.size() - 2].chord) << curve;
  }
}

TEST(LinuxcncCurves, WhatACurveCannotBeIsRefused) {
  const auto alarm = [](const std::string& blocks) { return linuxcnc_blocks("F100\n" + blocks).back(); };
  EXPECT_EQ(alarm("G5 X1 Y1 I0 J3 P0"), "alarm 1108 2:1");
  EXPECT_EQ(alarm("G5 X1 Y1 I0 P0 Q1"), "alarm 1108 2:1");
  EXPECT_EQ(alarm("G5 X1 Z1 I0 J1 P0 Q1"), "alarm 1107 2:7");
  EXPECT_EQ(alarm("G18 G5 X1 Y1 I0 J1 P0 Q1"), "alarm 1192 2:5");
  EXPECT_EQ(alarm("G93 G5 X1 Y1 I0 J1 P0 Q1 F9"), "alarm 1603 2:5");
  EXPECT_EQ(alarm("G5.2 X1 Y1\nG91\nX1"), "alarm 1645 3:1");
  EXPECT_EQ(alarm("G91 G5.2 X1 Y1"), "alarm 1192 2:5");
  EXPECT_EQ(alarm("G5.2 X1 Y1\nG0 X2"), "alarm 1645 3:1");
  EXPECT_EQ(alarm("G5.2 X1 Y1\nX2"), "alarm 1108 3:1");
  EXPECT_EQ(alarm("G5.2 X1 Y1\nX2 Y1 P0"), "alarm 1106 3:7");
  EXPECT_EQ(alarm("G5.2 X1 Y1 L5"), "alarm 1106 2:12");
  EXPECT_EQ(alarm("G5.2 X1 Y1\nG5.3"), "alarm 1255 3:1");
  EXPECT_EQ(alarm("G5.2 X1 Y1\nX2 Y2"), "alarm 1645 4:1");
  EXPECT_EQ(alarm("G5.3"), "alarm 1645 2:1");
  EXPECT_EQ(alarm("G5.2 X1 Y1\nX2 Y0\nG5.3\nX3"), "alarm 1641 5:1");
  EXPECT_EQ(linuxcnc_stream("%\nF100\nG5.2 X1 Y1\n%\n").back(), "alarm 1645 4:1");
}

/// The stream of a program whose probe touches at X, and the message behind it.
std::vector<std::string> probed(const std::string& blocks, double touched, double stopped,
                                InterpreterOptions options = {}) {
  TestMachine machine = linuxcnc_machine();
  const std::string program = blocks + "\nM2\n";
  StringSource source(program);
  Interpreter interpreter(machine, options);
  interpreter.start(source, {}, {});
  std::vector<std::string> texts;
  Command command;
  for (;;) {
    const Step step = interpreter.next(command);
    if (step == Step::end) return texts;
    if (step == Step::alarm) {
      texts.push_back("alarm " + std::to_string(static_cast<int>(interpreter.alarm().number)) + " " +
                      std::to_string(interpreter.alarm().line));
      return texts;
    }
    if (step == Step::position) interpreter.set_position({stopped}, {touched});
    if (step == Step::command && command.kind == CommandKind::message)
      texts.emplace_back(interpreter.message_text());
    else if (step == Step::command)
      texts.push_back(brief(command));
  }
}

TEST(LinuxcncProbing, AContactIsKnownAndWhereItWas) {
  EXPECT_THAT(probed("F100\nG38.2 X10\n(DEBUG,%d#5070 %.1f#5061 %.1f#5420)\nG91 G0 X1", 6.5, 7),
              ElementsAre("skip1 X10 F100", "1 6.5 7.0", "rapid X8", "end 2"));
  EXPECT_THAT(probed("F100\nG54 G92 X5\nG38.3 X10\n(DEBUG,%.1f#5061)", 3, 3),
              ElementsAre("skip1 X5 F100", "8.0", "end 2"));
}

TEST(LinuxcncProbing, WithoutContactOnlyG38_3GoesOn) {
  EXPECT_THAT(probed("F100\nG38.2 X10\nX1", 10, 10), ElementsAre("skip1 X10 F100", "alarm 1646 2"));
  EXPECT_THAT(probed("F100\nG38.3 X10\n(DEBUG,%d#5070 %.1f#5061)", 10, 10),
              ElementsAre("skip1 X10 F100", "0 10.0", "end 2"));
  // Where nothing moves every probe touches at its end.
  EXPECT_THAT(probed("F100\nG38.2 X10\n(DEBUG,%d#5070)", 10, 10, {0, true, true}),
              ElementsAre("skip1 X10 F100", "1", "end 2"));
}

TEST(LinuxcncProbing, WhatCannotBeProbedIsRefused) {
  EXPECT_THAT(linuxcnc_blocks("G38.2 X10"), ElementsAre("alarm 1111 1:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG38.2"), ElementsAre("alarm 1108 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG38.3 X0"), ElementsAre("alarm 1106 2:1"));
  EXPECT_THAT(linuxcnc_blocks("G95 F1\nG38.3 X1"), ElementsAre("alarm 1192 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG38.4 X1"), ElementsAre("alarm 1192 2:1"));
}

TEST(LinuxcncCodes, MachineCoordinatesNeedG0OrG1AndG90) {
  EXPECT_THAT(linuxcnc_blocks("G92 X5\nG53 G0 X1"), ElementsAre("rapid X1"));
  EXPECT_THAT(linuxcnc_blocks("G91 G53 G0 X1"), ElementsAre("alarm 1192 1:5"));
  EXPECT_THAT(linuxcnc_blocks("G80\nG53 X1"), ElementsAre("alarm 1301 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100 S100 M3\nG33 Z-1 K1\nG53 X1"),
              ElementsAre("S100", "M3", "thread Z-1 lead1", "alarm 1301 3:1"));
}

}  // namespace
}  // namespace trunnion::language::test
