// SPDX-License-Identifier: Apache-2.0
// Macros of the control for single codes: G37, G12 and G13, the rectangular pocket and CYCLE800, read with a
// machine as a channel reads them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "reading.hpp"

namespace trunnion::channel_setup::control_macros_test {
namespace {

using language::AxisValues;
using language::Command;
using language::CommandKind;
using enum language::Axis;

constexpr std::uint32_t tool_macro = 90370, circle_macro = 90120, rectangle_macro = 90150;

struct Execution {
  std::vector<Command> commands;
  std::string alarm;  ///< its text; empty when there was none
};

/// Reads `text` to its end. A skip move finds its contact where Z of the machine is `contact`, or none.
Execution run(ChannelSetup& setup, const std::string& text, std::optional<double> contact = std::nullopt) {
  language::StringSource source(text);
  language::Interpreter interpreter(setup);
  interpreter.start(source, {}, {});
  Execution result;
  Command command;
  for (;;) {
    const auto step = interpreter.next(command);
    if (step == language::Step::end) return result;
    if (step == language::Step::alarm) {
      result.alarm = interpreter.alarm().text.data();
      return result;
    }
    if (step == language::Step::command) result.commands.push_back(command);
    if (step == language::Step::answer) interpreter.answer(0);
    if (step != language::Step::position) continue;
    AxisValues touched = result.commands.back().target;
    if (contact) touched[Z] = *contact;
    AxisValues stopped = touched;
    if (contact) stopped[Z] -= 0.05;
    interpreter.set_position(stopped, touched);
  }
}

bool says(const Execution& result, const std::string& text) {
  return result.alarm.find(text) != std::string::npos;
}

/// The first command of this kind that the macro makes.
std::optional<Command> first_of(const Execution& result, std::uint32_t macro, CommandKind kind) {
  for (const Command& command : result.commands)
    if (command.program == macro && command.kind == kind) return command;
  return std::nullopt;
}

// G54 is at Z -380 and tool 1 is 100 mm long: the tip is at Z10 of the program where Z of the machine is
// -270.
TEST(ToolMeasuring, AddsTheDifferenceToTheWearAndUsesTheNewLength) {
  auto setup = test::setup_of("ac-table");
  const Execution result = run(setup, "G21 G90 G54 G94 F300\nG43 H1\nG0 Z50\nG37 Z10\nG0 Z15\nM30\n", -269.8);
  ASSERT_EQ(result.alarm, "");
  const auto rapid = first_of(result, tool_macro, CommandKind::rapid);
  const auto skip = first_of(result, tool_macro, CommandKind::skip);
  const auto wear = first_of(result, tool_macro, CommandKind::table);
  ASSERT_TRUE(rapid && skip && wear);
  EXPECT_NEAR(rapid->target[Z], -265, 1e-9) << "04c767 = 5 mm above";
  EXPECT_NEAR(skip->target[Z], -271, 1e-9) << "04c768 = 1 mm below";
  EXPECT_EQ(skip->modal.feed, 50);
  EXPECT_EQ(skip->number, 1u);
  EXPECT_EQ(wear->table, language::Table::tool_length_wear);
  EXPECT_EQ(wear->number, 1u);
  EXPECT_NEAR(wear->value, 0.2, 1e-9);
  const Command& behind = result.commands[result.commands.size() - 2];  // the last is the end
  EXPECT_NEAR(behind.target[Z], 15 - 380 + 100.2, 1e-9);
  EXPECT_EQ(behind.modal.feed, 300);
}

TEST(ToolMeasuring, ItsWordsGoBeforeTheParametersWhichCountInInchesToo) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.parameters.values[40770] = {3, ""};
  ChannelSetup setup(tables);
  const std::string begin = "G90 G54 G94 G43 H1\nG0 Z50\n";
  const Execution words = run(setup, "G21 " + begin + "G37 Z10 H1 R8 D2 F80\n", -270);
  ASSERT_EQ(words.alarm, "");
  EXPECT_NEAR(first_of(words, tool_macro, CommandKind::rapid)->target[Z], -262, 1e-9);
  const auto skip = first_of(words, tool_macro, CommandKind::skip);
  EXPECT_NEAR(skip->target[Z], -272, 1e-9);
  EXPECT_EQ(skip->modal.feed, 80);
  EXPECT_EQ(skip->number, 3u) << "04c770";
  // Z.5 is 12.7 mm: -267.3 in the machine.
  const Execution inches = run(setup, "G20 " + begin + "G37 Z.5\n", -267.3);
  ASSERT_EQ(inches.alarm, "");
  EXPECT_NEAR(first_of(inches, tool_macro, CommandKind::rapid)->target[Z], -262.3, 1e-9);
  EXPECT_NEAR(first_of(inches, tool_macro, CommandKind::skip)->target[Z], -268.3, 1e-9);
  EXPECT_NEAR(first_of(inches, tool_macro, CommandKind::skip)->modal.feed, 50, 1e-9);
  EXPECT_NEAR(first_of(inches, tool_macro, CommandKind::table)->value, 0, 1e-9);
}

TEST(ToolMeasuring, AContactOutsideOfItsRangeIsAnAlarmAndChangesNothing) {
  auto setup = test::setup_of("ac-table");
  const std::string begin = "G21 G90 G54 G94 F300\nG43 H1\nG0 Z50\n";
  const Execution none = run(setup, begin + "G37 Z10\n");
  EXPECT_TRUE(says(none, "no contact of the tool")) << none.alarm;
  const Execution early = run(setup, begin + "G37 Z10\n", -267);
  EXPECT_TRUE(says(early, "contact before the range")) << early.alarm;
  for (const Execution& result : {none, early})
    EXPECT_FALSE(first_of(result, tool_macro, CommandKind::table).has_value());
  EXPECT_TRUE(says(run(setup, begin + "G37 Z10 H2\n"), "H must be the active length"));
  EXPECT_TRUE(says(run(setup, begin + "G91 G37 Z-5\n"), "needs G90"));
  EXPECT_TRUE(says(run(setup, begin + "G49\nG37 Z10\n"), "needs G43"));
  EXPECT_TRUE(says(run(setup, begin + "G54.4 P1\nG37 Z10\n"), "needs G54.4 P0"));
  EXPECT_TRUE(says(run(setup, begin + "#2001=3\nG37 Z10\n"), "is not that of the table"));
}

using Point = std::array<double, 3>;

/// The way of the tool in the moves that the macro makes, program coordinates, in points at most `step`
/// apart.
std::vector<Point> way_of(const ChannelSetup& setup, const Execution& result, std::uint32_t macro,
                          double step) {
  const AxisValues zero = setup.work_offset(0);
  std::vector<Point> points;
  AxisValues from{};
  for (const Command& c : result.commands) {
    const bool arc = c.kind == CommandKind::arc;
    if (!arc && c.kind != CommandKind::rapid && c.kind != CommandKind::line) continue;
    const double along = from[X] - c.arc.centre[0], across = from[Y] - c.arc.centre[1];
    const double radius = std::hypot(along, across), angle = std::atan2(across, along);
    const double sweep = c.arc.sweep * (std::numbers::pi / 180) * (c.arc.clockwise ? -1 : 1);
    const double length =
        arc ? radius * std::abs(sweep)
            : std::hypot(c.target[X] - from[X], c.target[Y] - from[Y], c.target[Z] - from[Z]);
    const int pieces = 1 + static_cast<int>(length / step);
    for (int i = 0; i <= pieces && c.program == macro; ++i) {
      const double share = static_cast<double>(i) / pieces;
      Point p{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = from[axis] + share * (c.target[axis] - from[axis]) - zero[axis];
      if (arc) {
        p[0] = c.arc.centre[0] + radius * std::cos(angle + share * sweep) - zero[X];
        p[1] = c.arc.centre[1] + radius * std::sin(angle + share * sweep) - zero[Y];
      }
      points.push_back(p);
    }
    from = c.target;
  }
  return points;
}

std::vector<Point> at_depth(const std::vector<Point>& points, double z) {
  std::vector<Point> found;
  for (const Point& p : points)
    if (std::abs(p[2] - z) < 1e-6) found.push_back(p);
  return found;
}

/// A pocket about (x, y) with corners of `corner`; a circle is one whose corners are half its size.
struct Pocket {
  double x = 0, y = 0, half_x = 0, half_y = 0, corner = 0;

  /// Of a point from the wall, mm; negative inside.
  double distance(double px, double py) const {
    const double u = std::abs(px - x) - half_x + corner, v = std::abs(py - y) - half_y + corner;
    return std::hypot(std::max(u, 0.0), std::max(v, 0.0)) + std::min(std::max(u, v), 0.0) - corner;
  }
  Pocket less(double allowance) const {
    return {x, y, half_x - allowance, half_y - allowance, corner - allowance};
  }
};

/// How far the cutter goes beyond the wall; negative: how far it stays inside.
double beyond(const std::vector<Point>& way, const Pocket& pocket, double cutter) {
  double most = -1e9;
  for (const Point& p : way) most = std::max(most, pocket.distance(p[0], p[1]) + cutter);
  return most;
}

/// How far the place that is left of `pocket` is from the cutter; at most 0 when nothing is left.
double rest(const std::vector<Point>& way, const Pocket& pocket, double cutter) {
  constexpr int parts = 24;
  double most = -1e9;
  for (int i = -parts; i <= parts; ++i)
    for (int k = -parts; k <= parts; ++k) {
      const double px = pocket.x + pocket.half_x * i / parts, py = pocket.y + pocket.half_y * k / parts;
      if (pocket.distance(px, py) > 0) continue;
      double nearest = 1e9;
      for (const Point& p : way) nearest = std::min(nearest, std::hypot(p[0] - px, p[1] - py));
      most = std::max(most, nearest - cutter);
    }
  return most;
}

// Between points 0.1 mm apart the cutter of 5 mm is 5 - sqrt(25 - 0.05^2) = 0.00025 mm short.
// The way is taken as chords: of the smallest circle, radius 0.5 mm, they are 0.05^2 / (8 * 0.5) = 0.0006 mm
// off.
constexpr double point_step = 0.05, point_error = 0.001;

/// ac-table with D1 of 5 mm, 0.2 of which are wear.
ChannelSetup milling_machine() {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.tools.tools[0].radius = 5.2;
  tables.tools.tools[0].radius_wear = -0.2;
  return ChannelSetup(tables);
}

constexpr double cutter = 5;
const std::string mill = "G21 G17 G90 G54 G94\n";

TEST(CircularPocket, IsClearedToItsRadiusAndNoFarther) {
  auto setup = milling_machine();
  struct Case {
    const char* words;
    double radius, depth;
    bool clockwise;
  };
  for (const Case& c : {Case{"G13 I8 D1 Z-3 F200", 8, -3, false}, Case{"G12 I8 D1 Z-3 F200", 8, -3, true},
                        Case{"G13 I8 K20 Q7 D1 Z-3 F200", 20, -3, false},
                        Case{"G12 I9.9 K30.3 Q9.9 D1 F200 Z-1", 30.3, -1, true},
                        Case{"D1\nG90 G13 X10 Y-5 I5.5 K6 Q4 Z-2 F200", 6, -2, false},
                        Case{"G90.1\nG13 I8 D1 Z-3 F200", 8, -3, false}}) {
    const Execution result = run(setup, mill + "G0 X10 Y-5 Z2\n" + c.words + "\nG0 Z9\nM30\n");
    ASSERT_EQ(result.alarm, "") << c.words;
    const auto way = at_depth(way_of(setup, result, circle_macro, point_step), c.depth);
    const Pocket pocket{10, -5, c.radius, c.radius, c.radius};
    EXPECT_NEAR(beyond(way, pocket, cutter), 0, 1e-6) << c.words;
    EXPECT_LT(rest(way, pocket, cutter), point_error) << c.words;
    for (const Command& command : result.commands) {
      if (command.kind == CommandKind::arc) {
        EXPECT_EQ(command.arc.clockwise, c.clockwise) << c.words;
      }
    }
    // It ends at its centre, and G0 goes up from there.
    const Command& up = result.commands[result.commands.size() - 2];
    EXPECT_NEAR(up.target[X], 10, 1e-9);
    EXPECT_NEAR(up.target[Y], -5, 1e-9);
  }
}

// With D0 the words are those of the tool's centre: it goes round at 8 mm.
TEST(CircularPocket, WithoutARadiusIsTheWayOfTheCentre) {
  auto setup = milling_machine();
  const Execution result = run(setup, mill + "G0 Z2\nG13 I8 D0 Z-3 F200\n");
  ASSERT_EQ(result.alarm, "");
  EXPECT_NEAR(beyond(way_of(setup, result, circle_macro, point_step), {0, 0, 8, 8, 8}, 0), 0, 1e-6);
}

// L passes, each of them Z deeper, from Z2: the whole circle is cut at each.
TEST(CircularPocket, GoesDownInPassesInIncrementalWords) {
  auto setup = milling_machine();
  const Execution result = run(setup, mill + "G0 Z2\nG91 G13 I8 D1 Z-1.5 L3 F200\nM30\n");
  ASSERT_EQ(result.alarm, "");
  const auto way = way_of(setup, result, circle_macro, point_step);
  const Pocket pocket{0, 0, 8, 8, 8};
  double lowest = 0;
  for (const Point& p : way) lowest = std::min(lowest, p[2]);
  EXPECT_NEAR(lowest, 2 - 3 * 1.5, 1e-9);
  for (const double depth : {0.5, -1.0, -2.5})
    EXPECT_NEAR(beyond(at_depth(way, depth), pocket, cutter), 0, 1e-6) << depth;
  EXPECT_FALSE(result.commands.back().modal.absolute) << "G91 stays";
}

TEST(CircularPocket, WhatItCannotClearIsRefused) {
  auto setup = milling_machine();
  const auto refused = [&](const std::string& words, const std::string& text) {
    const Execution result = run(setup, mill + "G0 Z2\n" + words + "\n");
    EXPECT_TRUE(says(result, text)) << words << ": " << result.alarm;
    EXPECT_FALSE(first_of(result, circle_macro, CommandKind::arc).has_value()) << words;
  };
  refused("G13 D1 Z-1 F200", "need the radius I");
  refused("G13 I8 Z-1 F200", "need the cutter radius D");
  refused("G13 I5 D1 Z-1 F200", "above that of the cutter");
  refused("G13 I8 K7 Q1 D1 F200", "K must be above I");
  refused("G13 I8 K20 D1 F200", "needs a step Q");
  refused("G13 I8 Q2 D1 F200", "Q needs K");
  refused("G13 I10 K20 Q3 D1 F200", "below the cutter diameter");
  refused("G13 I8 K20 Q10 D1 F200", "below the cutter diameter");
  refused("G13 I8 D1 Z-1 L2 F200", "need Z in G91");
  refused("G18\nG13 I8 D1 Z-1 F200", "need G17");
}

TEST(RectangularPocket, IsClearedToItsAllowanceInEveryPassAndNoFarther) {
  auto setup = milling_machine();
  struct Case {
    const char* words;
    Pocket pocket;
    double allowance;
    std::vector<double> depths;
  };
  const std::vector<Case> cases{
      // From R1 to Z-6 in passes of at most 3 mm: three of 7/3.
      {"X60 Y40 Z-6 R1 C8 Q3", {3, 4, 30, 20, 8}, 0, {1 - 7.0 / 3, 1 - 14.0 / 3, -6}},
      {"X60 Y40 Z-6 R1 K0.5", {3, 4, 30, 20, 5.5}, 0.5, {-6}},
      {"X30 Y44 Z-2 R0 I8.5 C6 K1", {3, 4, 15, 22, 6}, 1, {-2}},
      {"X10 Y40 Z-2 R0", {3, 4, 5, 20, 5}, 0, {-2}},                 // as wide as the cutter
      {"X33 Y33 Z-2 R0 C16.5", {3, 4, 16.5, 16.5, 16.5}, 0, {-2}}};  // a circle
  const std::string begin = mill + "G90.1 G0 X3 Y4 Z9\nG65 P90150 D1 F500 E100 ";
  for (const Case& c : cases) {
    const Execution result = run(setup, begin + c.words + "\nG0 X0\nM30\n");
    ASSERT_EQ(result.alarm, "") << c.words;
    EXPECT_TRUE(result.commands.back().modal.absolute_centres) << "G90.1 of the program stays";
    const auto way = way_of(setup, result, rectangle_macro, point_step);
    for (const double depth : c.depths) {
      const auto pass = at_depth(way, depth);
      EXPECT_NEAR(beyond(pass, c.pocket, cutter), -c.allowance, 1e-5) << c.words << " at " << depth;
      EXPECT_LT(rest(pass, c.pocket.less(c.allowance), cutter), point_error) << c.words << " at " << depth;
    }
    // On the way to a pass, too, it stays inside.
    EXPECT_LT(beyond(way, c.pocket, cutter), 1e-5 - c.allowance) << c.words;
  }
}

TEST(RectangularPocket, WhatItCannotClearIsRefused) {
  auto setup = milling_machine();
  const auto refused = [&](const std::string& words, const std::string& text) {
    const Execution result = run(setup, mill + "G0 Z9\nG65 P90150 " + words + "\n");
    EXPECT_TRUE(says(result, text)) << words << ": " << result.alarm;
    EXPECT_FALSE(first_of(result, rectangle_macro, CommandKind::line).has_value()) << words;
  };
  refused("X9 Y40 Z-6 R1 D1 F500", "the tool does not fit");
  refused("X20 Y40 Z-6 R-7 D1 F500", "R must be above Z");
  refused("X20 Y40 R1 D1 F500", "needs the bottom Z and the level R");
  refused("X20 Y40 Z-6 R1 F500", "needs the cutter radius D");
  refused("X20 Y40 Z-6 R1 D1", "needs the feed F");
  refused("X20 Y40 Z-6 R1 D1 C4 F500", "C must be at least the cutter radius");
  refused("X20 Y40 Z-6 R1 D1 C11 F500", "C must be at most half");
  refused("X20 Y40 Z-6 R1 D1 I8.6 F500", "the step I");
}

using Matrix = std::array<double, 9>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t k = 0; k < 3; ++k) c[i] += a[i / 3 * 3 + k] * b[3 * k + i % 3];
  return c;
}

Matrix about(char axis, double degrees) {
  const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
  if (axis == 'X') return {1, 0, 0, 0, c, -s, 0, s, c};
  if (axis == 'Y') return {c, 0, s, 0, 1, 0, -s, 0, c};
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

void expect_matrix(const Matrix& found, const Matrix& expected, const std::string& which) {
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << which << " " << i;
}

/// The state behind a call of CYCLE800 at the axes' zero.
language::ModalState behind(ChannelSetup& setup, const std::string& arguments) {
  const Execution result = run(setup, mill + "F1000\nCYCLE800(" + arguments + ")\n");
  EXPECT_EQ(result.alarm, "") << arguments;
  return result.commands.empty() ? language::ModalState{} : result.commands.back().modal;
}

// Each rotation is about an axis of the frame that those before have turned.
TEST(Swivel, TurnsAboutTheAxesInTheSequenceOfItsMode) {
  auto setup = test::setup_of("ac-table");
  for (const auto& [mode, axes] :
       {std::pair("57", "XYZ"), {"45", "XZY"}, {"54", "YXZ"}, {"30", "YZX"}, {"39", "ZXY"}, {"27", "ZYX"}}) {
    const auto modal =
        behind(setup, std::string("0,\"TABLE\",200000,") + mode + ",10,20,30,5,15,25,1,2,3,1,100,1");
    const Matrix r = product(product(about(axes[0], 5), about(axes[1], 15)), about(axes[2], 25));
    EXPECT_TRUE(modal.tilt.active) << mode;
    expect_matrix(modal.tilt.matrix, r, mode);
    // The zero of the plane is 1, 2, 3 along its own axes beside the reference point.
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(modal.tilt.origin[i],
                  10.0 * static_cast<double>(i + 1) + r[3 * i] + 2 * r[3 * i + 1] + 3 * r[3 * i + 2], 1e-9)
          << mode;
  }
}

TEST(Swivel, SolidAndProjectionAngles) {
  auto setup = test::setup_of("ac-table");
  const auto solid = behind(setup, "0,\"\",0,64,0,0,0,40,25,0,0,0,0,1,0,1");
  expect_matrix(solid.tilt.matrix, product(about('Z', 40), about('Y', 25)), "solid");
  // The plane cuts the YZ plane along a line turned by 20 degrees about X, the ZX plane along one turned by
  // 30 about Y, which is its X axis.
  const double a = 20 * std::numbers::pi / 180, b = 30 * std::numbers::pi / 180;
  for (const char* const arguments :
       {"0,\"\",0,185,0,0,0,20,30,0,0,0,0,1,0,1", "0,\"\",0,182,0,0,0,30,20,0,0,0,0,1,0,1"}) {
    const Matrix m = behind(setup, arguments).tilt.matrix;
    EXPECT_NEAR(m[0], std::cos(b), 1e-12);
    EXPECT_NEAR(m[3], 0, 1e-12);
    EXPECT_NEAR(m[6], -std::sin(b), 1e-12);
    EXPECT_NEAR(m[5] * std::cos(a) + m[8] * std::sin(a), 0, 1e-12) << "normal and line of the YZ plane";
    EXPECT_GT(m[8], 0);
  }
}

// The table reaches a plane that leans by 45 degrees with A45 and with A-45.
TEST(Swivel, ItsDirectionChoosesTheSolutionWhereTheAxisReachesIt) {
  const std::string call = "CYCLE800(0,\"TABLE\",200000,57,0,0,0,0,45,0,0,0,0,";
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  const auto a_behind = [&](const std::string& direction) {
    ChannelSetup setup(tables);
    const Execution result = run(setup, mill + "F1000\n" + call + direction + ",100,1)\n");
    EXPECT_EQ(result.alarm, "");
    return result.commands.empty() ? 0 : result.commands.back().target[A];
  };
  EXPECT_NEAR(a_behind("1"), 45, 1e-9);
  EXPECT_NEAR(a_behind("-1"), -45, 1e-9);
  tables.parameters.values[103007] = {-10, ""};  // travel of A
  EXPECT_NEAR(a_behind("-1"), 45, 1e-9);
}

TEST(Swivel, TheNameZeroAndACallWithoutArgumentsTakeThePlaneBack) {
  auto setup = test::setup_of("ac-table");
  for (const char* const back : {"CYCLE800", "CYCLE800()", "CYCLE800 ; off",
                                 "CYCLE800(1,\"0\",200000,57,0,0,0,0,0,0,0,0,0,1,100,1)"}) {
    const Execution result =
        run(setup, mill + "F1000\nCYCLE800(0,\"TABLE\",0,57,0,0,0,0,20,0,0,0,0,1,0,1)\n" + back + "\nM30\n");
    ASSERT_EQ(result.alarm, "") << back;
    EXPECT_FALSE(result.commands.back().modal.tilt.active) << back;
    EXPECT_NEAR(result.commands.back().target[A], 20, 1e-9) << back << " moves nothing";
  }
}

// The retract is the way of G28. The sample programs of CYCLE9960 begin so, and need no plane behind.
TEST(Swivel, WithoutRotationTheAxesGoToZeroAndNoPlaneIsActive) {
  auto setup = test::setup_of("ac-table");
  const Execution result = run(
      setup,
      mill + "G0 Z-100 A10 C20\nCYCLE800(1,\"TOOL_CARR_KIN\",200000,57,0,0,0,0,0,0,0,0,0,1,100,1)\nM30\n");
  ASSERT_EQ(result.alarm, "");
  const Command& last = result.commands.back();
  EXPECT_FALSE(last.modal.tilt.active);
  EXPECT_NEAR(last.target[A], 0, 1e-9);
  EXPECT_NEAR(last.target[C], 0, 1e-9);
  EXPECT_NEAR(last.target[Z], setup.reference_position()[Z], 1e-9);
}

// SINUMERIK ONE, "Measure kinematics with CYCLE9960" (A650): the calls of the sample programs, as printed.
TEST(Swivel, TheCallsOfTheSampleProgramsAreCarriedOut) {
  auto setup = test::setup_of("ac-table");
  const std::string swivel =
      "CYCLE800(1,\"TOOL_CARR_KIN\",200000,57,0,0,0,0,0,0,0,0,0,1,100,1)\nG0 X0 Y0 Z20\n";
  const std::string back = "CYCLE800(1,\"0\",200000,57,0,0,0,0,0,0,0,0,0,1,100,1)\nM30\n";
  for (const char* const measure :
       {"CYCLE9960(11400,\"TOOL_CARR_KIN\",1,30,0,0,180,3,0,0,0,240,3,0,0.001,2,2,1,1,0,1)\n",
        "CYCLE9960(11400,\"TOOL_CARR_KIN\",1,30,0,-90,0,3,0,0,0,240,3,0,0.001,2,2,1,1,0,1)\n",
        "CYCLE9960(11400,\"TOOL_CARR_KIN\",1,30,0,0,240,3,90,0,-90,90,3,0,0.001,2,2,1,1,0,1)\n"})
    EXPECT_EQ(run(setup, "G54 G17\n" + swivel + measure + back).alarm, "") << measure;
  const Execution one_axis =
      run(setup,
          "CYCLE800\nG54\nD1\nG17 G54 G90\n"
          "CYCLE800(1,\"TOOL_CARR_KIN\",200000,57,0,0,0,0,0,0,0,0,0,1,100,101)\n"
          "G0 Z300\nG0 X0 Y0\nG0 Z20\n"
          "CYCLE9960(11400,\"TOOL_CARR_KIN\",1,30,0,-90,90,6,0,0,0,0,3,0,0.1,3,2,1,1,10,1)\n"
          "CYCLE800\nM30\n");
  EXPECT_EQ(one_axis.alarm, "");
}

TEST(Swivel, WhatIsNotKnownIsRefusedWithItsArgument) {
  auto setup = test::setup_of("ac-table");
  const auto refused = [&](const std::string& arguments, const std::string& text) {
    const Execution result = run(setup, mill + "F1000\nCYCLE800(" + arguments + ")\n");
    EXPECT_TRUE(says(result, text)) << arguments << ": " << result.alarm;
  };
  refused("4,\"\",0,57,0,0,0,0,10,0,0,0,0,1,0,1", "argument 1");
  refused("0,\"\",1,57,0,0,0,0,10,0,0,0,0,1,0,1", "additive");
  refused("0,\"\",100,57,0,0,0,0,10,0,0,0,0,1,0,1", "argument 3");
  refused("0,\"\",0,58,0,0,0,0,10,0,0,0,0,1,0,1", "argument 4");
  refused("0,\"\",0,192,0,0,0,0,10,0,0,0,0,1,0,1", "direct positions");
  refused("0,\"\",0,155,0,0,0,0,10,0,0,0,0,1,0,1", "projection angles");
  refused("0,\"\",0,57,0,0,0,0,10,0,0,0,0,0,0,1", "argument 14");
  refused("0,\"\",0,57,0,0,0,0,10,0,0,0,0,1,0,2", "argument 16");
}

}  // namespace
}  // namespace trunnion::channel_setup::control_macros_test
