// SPDX-License-Identifier: Apache-2.0
// Chamfers ,C and roundings ,R between two moves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "language/planar_piece.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_with_cutter() {
  TestMachine machine;
  machine.tools[1] = {0, 0, 5, 0};
  return machine;
}

Interpretation run_good(const std::string& text) {
  TestMachine machine = machine_with_cutter();
  Interpretation result = run(machine, text);
  EXPECT_EQ(result.last, Step::end) << result.alarm.text.data();
  return result;
}

void expect_end(const Command& command, double x, double y) {
  EXPECT_NEAR(command.target[X], x, 1e-9);
  EXPECT_NEAR(command.target[Y], y, 1e-9);
}

TEST(Corner, AChamferBeginsAndEndsItsLengthFromTheCorner) {
  const auto result = run_good("G1 X20 ,C3 F100\nY-10\nM30\n");
  ASSERT_EQ(result.commands.size(), 4u);
  expect_end(result.commands[0], 17, 0);
  expect_end(result.commands[1], 20, -3);
  expect_end(result.commands[2], 20, -10);
  EXPECT_EQ(result.commands[1].kind, CommandKind::line);
  EXPECT_EQ(result.commands[1].line, 1u) << "a search and a restart find it at the block that asks for it";
  EXPECT_EQ(result.commands[2].line, 2u);
}

// A right angle: the arc begins and ends its radius from the corner, the centre is inside.
TEST(Corner, ARoundingIsTangentialToBothLines) {
  const auto result = run_good("G1 X20,R4 F100\n(a comment, and a block without motion)\n#1=3\nY10\nM30\n");
  ASSERT_EQ(result.commands.size(), 4u);
  expect_end(result.commands[0], 16, 0);
  expect_end(result.commands[1], 20, 4);
  ASSERT_EQ(result.commands[1].kind, CommandKind::arc);
  EXPECT_FALSE(result.commands[1].arc.clockwise);
  EXPECT_NEAR(result.commands[1].arc.sweep, 90, 1e-9);
  EXPECT_NEAR(result.commands[1].arc.centre[0], 16, 1e-9);
  EXPECT_NEAR(result.commands[1].arc.centre[1], 4, 1e-9);
}

TEST(Corner, AClosedContourHasACornerAtEveryEnd) {
  const auto result = run_good("G1 X0 Y5 F100\nX0 Y20 ,R2\nX30 ,C1\nY0 ,R3\nX0 ,C2\nY5\nM30\n");
  // lead, then line and corner four times, the last line, the end
  ASSERT_EQ(result.commands.size(), 11u);
  for (std::size_t i = 0; i < result.commands.size(); ++i) EXPECT_EQ(result.commands[i].sequence, i + 1);
  expect_end(result.commands[1], 0, 18);
  expect_end(result.commands[2], 2, 20);
  EXPECT_TRUE(result.commands[2].arc.clockwise);
  expect_end(result.commands[3], 29, 20);
  expect_end(result.commands[4], 30, 19);
  expect_end(result.commands[7], 2, 0);
  expect_end(result.commands[8], 0, 2);
  expect_end(result.commands[9], 0, 5);
}

TEST(Corner, IncrementalWordsAndInchesReferToTheCornerItself) {
  const auto result = run_good("G20 G91\nG1 X2 ,R0.5 F10\nY1\nM30\n");
  ASSERT_EQ(result.commands.size(), 4u);
  expect_end(result.commands[0], 1.5 * 25.4, 0);
  expect_end(result.commands[2], 2 * 25.4, 25.4);
}

// Offset by the radius 5 to the left of the contour, an inside rounding of 8 becomes one of 3.
TEST(Corner, TheCompensationSeesTheRoundedContour) {
  const auto result = run_good("G41 D1 G1 X0 Y0 F100\nX10\nX40 ,R8\nY40\nG40 X60 Y60\nM30\n");
  bool seen = false;
  for (const Command& command : result.commands) {
    if (command.kind != CommandKind::arc) continue;
    seen = true;
    EXPECT_NEAR(command.arc.centre[0], 32, 1e-9);
    EXPECT_NEAR(command.arc.centre[1], 8, 1e-9);
    EXPECT_NEAR(std::hypot(command.target[X] - 32, command.target[Y] - 8), 3, 1e-9);
  }
  EXPECT_TRUE(seen);
}

TEST(Corner, WhatDoesNotFitOrHasNoMoveBehindItIsAnAlarm) {
  struct Case {
    const char* text;
    AlarmNumber number;
    const char* says;
  };
  const Case cases[] = {
      {"G1 X20 ,C3 F100\nM30\n", AlarmNumber::corner_without_move, ""},
      {"G1 X20 ,R3 F100\nM8\nY10\nM30\n", AlarmNumber::corner_without_move, ""},
      {"G1 X20 ,R3 F100\nG0 Y10\nM30\n", AlarmNumber::corner_without_move, ""},
      {"G1 X20 ,R3 F100\nG1 Y10 Z5\nM30\n", AlarmNumber::corner_without_move, ""},
      {"G1 X20 ,R3 F100\nG18 G1 X10\nM30\n", AlarmNumber::corner_without_move, ""},
      {"G1 X20 ,R3 F100\nG4 P1\nG1 Y10\nM30\n", AlarmNumber::corner_without_move, ""},
      {"G1 X20 ,R3 F100\n", AlarmNumber::corner_without_move, ""},
      {"G1 X20 ,R3 F100\nG41 D1 G1 Y10\nM30\n", AlarmNumber::corner_without_move, ""},
      {"G1 X20 ,R11 F100\nY10\nM30\n", AlarmNumber::corner_too_large, "11 mm in line 1, moves 20 and 10 mm"},
      {"G1 X20 ,C21 F100\nY30\nM30\n", AlarmNumber::corner_too_large, "21 mm in line 1, moves 20 and 30 mm"},
      {"G1 X20 ,R3 F100\nX5\nM30\n", AlarmNumber::corner_too_large, ""},
      {"G1 X20 ,C3 F100\nG2 X40 R10\nM30\n", AlarmNumber::corner_chamfer_arc, "line 1"},
      {"G0 X20 ,C3\nY10\nM30\n", AlarmNumber::unused_word, ",C"},
      {"G1 X20 ,C3 ,R2 F100\nY10\nM30\n", AlarmNumber::codes_compete, ""},
      {"G1 X20 ,C-3 F100\nY10\nM30\n", AlarmNumber::value_range, ""},
      {"G1 X20 ,C3 ,C2 F100\nY10\nM30\n", AlarmNumber::letter_twice, ""},
      {"G1 X20 ,B3 F100\nY10\nM30\n", AlarmNumber::unknown_character, ""},
      {"G1 X20 , F100\nM30\n", AlarmNumber::unknown_character, ""},
  };
  for (const Case& c : cases) {
    TestMachine machine = machine_with_cutter();
    const auto result = run(machine, c.text);
    EXPECT_EQ(result.last, Step::alarm) << c.text;
    EXPECT_EQ(result.alarm.number, c.number) << c.text << result.alarm.text.data();
    EXPECT_NE(std::string(result.alarm.text.data()).find(c.says), std::string::npos)
        << result.alarm.text.data();
  }
}

TEST(Corner, AMoveThatACornerUsesUpIsLeftOutAndHasNoCornerOfItsOwn) {
  const auto result = run_good("G1 X20 ,R10 F100\nY10\nX0\nM30\n");
  ASSERT_EQ(result.commands.size(), 4u);
  EXPECT_EQ(result.commands[1].kind, CommandKind::arc);
  expect_end(result.commands[1], 20, 10);
  expect_end(result.commands[2], 0, 10);
  for (const char* corner : {",R2", ",C2"}) {
    TestMachine machine = machine_with_cutter();
    const auto refused = run(machine, std::string("G1 X20 ,R10 F100\nY10 ") + corner + "\nX0\nM30\n");
    EXPECT_EQ(refused.last, Step::alarm) << corner;
    EXPECT_EQ(refused.alarm.number, AlarmNumber::corner_too_large) << corner;
  }
}

TEST(Corner, ASizeOfZeroAndTangentialMovesNeedNoCorner) {
  EXPECT_EQ(run_good("G1 X20 ,C0 F100\nY10\nM30\n").commands.size(), 3u);
  EXPECT_EQ(run_good("G1 X20 ,R5 F100\nX30\nM30\n").commands.size(), 3u);
  EXPECT_EQ(run_good("G1 X20 ,R5 F100\nG3 X30 Y10 R10\nM30\n").commands.size(), 3u);
}

// Two random pieces, lines or arcs, with a corner between them. Independent of the construction: the arc has
// the programmed radius, its ends are on both pieces, and the directions there are the same (a turn of 1e-6
// rad at the smallest radius of 0.5 mm is 0.5 nm of position).
TEST(Corner, RandomRoundingsAreTangentialAndHaveTheirRadius) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-30, 30), radius(0.5, 6), bend(-1.5, 1.5);
  int rounded = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto word = [&](double x, double y, bool arc) {
      char text[96];
      const double r = 40 + 20 * std::abs(bend(random));
      std::snprintf(text, sizeof text, arc ? "%s X%.4f Y%.4f R%.4f" : "%s X%.4f Y%.4f",
                    arc ? (i % 2 ? "G2" : "G3") : "G1", x, y, r);
      return std::string(text);
    };
    const double r = std::round(radius(random) * 1e4) / 1e4;
    const std::string text = "G1 X0 Y0.001 F100\n" + word(place(random), place(random), i % 3 == 0) + " ,R" +
                             std::to_string(r) + "\n" + word(place(random), place(random), i % 5 == 0) +
                             "\nM30\n";
    TestMachine machine = machine_with_cutter();
    const auto result = run(machine, text);
    if (result.last != Step::end) {
      EXPECT_EQ(result.alarm.number, AlarmNumber::corner_too_large) << text << result.alarm.text.data();
      continue;
    }
    ASSERT_EQ(result.commands.size(), 5u) << text;
    ++rounded;
    const PlaneAxes xy = plane_axes(Plane::xy);
    const auto& c = result.commands;
    const auto first = planar_piece(c[1], c[0].target, xy), arc = planar_piece(c[2], c[1].target, xy),
               second = planar_piece(c[3], c[2].target, xy);
    EXPECT_NEAR(length(arc.start - arc.centre), r, 1e-9) << text;
    EXPECT_NEAR(length(arc.end - arc.centre), r, 1e-9) << text;
    EXPECT_NEAR(cross(first.tangent_at_end(), arc.tangent_at_start()), 0, 1e-6) << text;
    EXPECT_NEAR(cross(arc.tangent_at_end(), second.tangent_at_start()), 0, 1e-6) << text;
    EXPECT_GT(dot(first.tangent_at_end(), arc.tangent_at_start()), 0) << text;
    EXPECT_GT(dot(arc.tangent_at_end(), second.tangent_at_start()), 0) << text;
    if (second.arc) {
      EXPECT_NEAR(length(second.start - second.centre), length(second.end - second.centre), 1e-6) << text;
    }
  }
  EXPECT_GT(rounded, 1000);
}

}  // namespace
}  // namespace trunnion::language::test
