// SPDX-License-Identifier: Apache-2.0
// The compensated tool lies at its radius from the contour, never closer.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "compensation_contour.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

constexpr double radius = 2;

// A contour of lines and arcs that always runs forward along X, so that it never meets itself, with corners
// to both sides. Headings stay within 80 degrees of X and every piece is long enough for the tool in any
// corner between two of them: 2 / tan(10 degrees) = 11.3 on either side.
Contour random_contour(std::mt19937_64& random, int pieces, bool arcs) {
  std::uniform_real_distribution<double> heading(-80, 80);
  std::uniform_real_distribution<double> size(30, 60);
  std::vector<PlanarPiece> contour;
  Vector2 at{0, 0};
  for (int i = 0; i < pieces; ++i) {
    const double begin = heading(random) * std::numbers::pi / 180;
    PlanarPiece piece;
    piece.start = at;
    if (arcs && random() % 2 == 0) {
      const double end = heading(random) * std::numbers::pi / 180;
      const double sweep = end - begin;
      // Long enough, and not sharper than the tool.
      if (std::abs(sweep) > 0.1) {
        const double r = size(random) / std::min(1.0, std::abs(sweep));
        piece.arc = true;
        piece.sweep = sweep;
        const Vector2 left = left_of({std::cos(begin), std::sin(begin)});
        piece.centre = at + (sweep > 0 ? r : -r) * left;
        const Vector2 from = at - piece.centre;
        piece.end = piece.centre + std::cos(sweep) * from + std::sin(sweep) * left_of(from);
      }
    }
    if (!piece.arc) piece.end = at + size(random) * Vector2{std::cos(begin), std::sin(begin)};
    contour.push_back(piece);
    at = piece.end;
  }
  return words_of(std::move(contour));
}

Interpretation compensated(TestMachine& machine, const Contour& contour, const char* side,
                           const std::string& before = "") {
  machine.tools[1] = {0, 0, radius, 0};
  // The way in comes from behind, so the first corner is not sharp.
  return run(machine, before + "G90 F100\nG0 X-20 Y0\n" + side + " D1 G1 X0 Y0\n" + contour.text +
                          "G40 G1 G91 X20\nM30\n");
}

TEST(CompensationProperty, ToolIsAtItsRadiusFromTheContourEverywhere) {
  std::mt19937_64 random(31);
  for (int i = 0; i < 300; ++i) {
    const Contour contour = random_contour(random, 12, i % 3 != 0);
    for (const char* const side : {"G41", "G42"}) {
      TestMachine machine;
      const Interpretation result = compensated(machine, contour, side);
      ASSERT_EQ(result.last, Step::end) << result.alarm.text.data() << "\n" << contour.text;
      const std::vector<Vector2> path = tool_path(result);
      ASSERT_GT(path.size(), 200u);
      for (const Vector2 point : path) {
        // Words carry 5e-10; a corner of 160 degrees amplifies that by 1 / sin(10 degrees) = 6.
        ASSERT_NEAR(distance_from(point, contour.pieces), radius, 1e-6) << side << "\n" << contour.text;
      }
    }
  }
}

TEST(CompensationProperty, AMirrorGivesTheMirroredToolPath) {
  std::mt19937_64 random(32);
  for (int i = 0; i < 100; ++i) {
    const Contour contour = random_contour(random, 8, true);
    TestMachine machine;
    const Interpretation plain = compensated(machine, contour, "G41");
    const Interpretation mirrored = compensated(machine, contour, "G41", "G51.1 Y0\n");
    ASSERT_EQ(plain.last, Step::end) << plain.alarm.text.data();
    ASSERT_EQ(mirrored.last, Step::end) << mirrored.alarm.text.data();
    ASSERT_EQ(plain.commands.size(), mirrored.commands.size());
    for (std::size_t k = 0; k < plain.commands.size(); ++k) {
      EXPECT_NEAR(plain.commands[k].target[X], mirrored.commands[k].target[X], 1e-9);
      EXPECT_NEAR(plain.commands[k].target[Y], -mirrored.commands[k].target[Y], 1e-9);
      if (plain.commands[k].kind != CommandKind::arc) continue;
      EXPECT_NE(plain.commands[k].arc.clockwise, mirrored.commands[k].arc.clockwise);
      EXPECT_NEAR(plain.commands[k].arc.sweep, mirrored.commands[k].arc.sweep, 1e-7);
    }
  }
}

TEST(CompensationProperty, ARotationTurnsTheToolPath) {
  std::mt19937_64 random(33);
  for (int i = 0; i < 100; ++i) {
    const Contour contour = random_contour(random, 8, true);
    TestMachine machine;
    const Interpretation plain = compensated(machine, contour, "G42");
    const Interpretation turned = compensated(machine, contour, "G42", "G68 X0 Y0 R90\n");
    ASSERT_EQ(plain.commands.size(), turned.commands.size());
    for (std::size_t k = 0; k < plain.commands.size(); ++k) {
      EXPECT_NEAR(plain.commands[k].target[X], turned.commands[k].target[Y], 1e-9);
      EXPECT_NEAR(plain.commands[k].target[Y], -turned.commands[k].target[X], 1e-9);
    }
  }
}

// Walls that come together: no corner is too tight, but two moves on the tool would cut the first wall.
const std::string converging = "G41 D1 G1 X1 F100\nX30\nY20\nX1 Y1\nG40 X-20\n";

TEST(CompensationInterference, OfWallsThatComeTogetherIsSeen) {
  TestMachine machine;
  machine.tools[1] = {0, 0, 5, 0};
  const Interpretation result = run(machine, converging);
  EXPECT_EQ(result.alarm.number, AlarmNumber::compensation_interference);
  EXPECT_EQ(result.alarm.line, 2u);
  // Nothing of the move that would cut has been given out.
  for (const Command& command : result.commands) EXPECT_LE(command.line, 1u);
}

TEST(CompensationInterference, IsLookedForAsFarAsTheParametersSay) {
  TestMachine machine;
  machine.tools[1] = {0, 0, 5, 0};
  machine.cutter.check_blocks = 1;
  EXPECT_EQ(run(machine, converging).last, Step::end);
  machine.cutter.check_blocks = 2;
  machine.cutter.interference_check = false;
  EXPECT_EQ(run(machine, converging).last, Step::end);
}

// The arc about (66.05, 3.16) ends in the direction -50.08 deg, the line goes on at 129.47 deg: 179.55 deg to
// the left. It cannot be cut inside, so the tool goes round the outside, clockwise by the other 180.45 deg.
TEST(CompensationReversal, OfLittleLessThanHalfATurnIsGoneRoundByLittleMore) {
  TestMachine machine;
  machine.tools[1] = {0, 0, 2, 0};
  const Interpretation result =
      run(machine, "G41 D1 G1 X10 F100\nX30 Y-8\nG3 X27 Y-23 R23\nX30 Y-27 R47\nG1 X-12 Y24\nG40 X-60\n");
  EXPECT_EQ(result.last, Step::end) << result.alarm.text.data();
  Vector2 at{0, 0};
  int found = 0;
  for (const Command& command : result.commands) {
    const Vector2 to{command.target[X], command.target[Y]};
    if (command.kind == CommandKind::arc && command.line == 5) {
      ++found;
      EXPECT_TRUE(command.arc.clockwise);
      EXPECT_NEAR(command.arc.sweep, 180.4465, 1e-4);
      const Vector2 centre{30, -27};
      const double angle = -command.arc.sweep * std::numbers::pi / 180;
      const Vector2 end = centre + std::cos(angle) * (at - centre) + std::sin(angle) * left_of(at - centre);
      EXPECT_NEAR(end.u, to.u, 1e-9);
      EXPECT_NEAR(end.v, to.v, 1e-9);
    }
    at = to;
  }
  EXPECT_EQ(found, 1);
}

TEST(CompensationProperty, RandomContoursEndInAPathOrAnAlarm) {
  std::mt19937_64 random(34);
  int paths = 0;
  int alarms = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = "F100 G41 D1 G1 X10\n";
    std::uniform_int_distribution<int> value(-30, 30);
    for (int k = 0; k < 8; ++k) {
      char line[80];
      const int kind = static_cast<int>(random() % 4);
      // One after the other: compilers evaluate arguments in different orders.
      const int r = 40 + value(random), y = value(random), x = value(random);
      std::snprintf(line, sizeof line, kind < 2 ? "G1 X%d Y%d\n" : "G%4$d X%1$d Y%2$d R%3$d\n", x, y, r,
                    kind);
      text += line;
    }
    TestMachine machine;
    machine.tools[1] = {0, 0, 1 + static_cast<double>(random() % 10), 0};
    const Interpretation result = run(machine, text + "G40 G1 X100\n");
    Vector2 at{0, 0};
    for (const Command& command : result.commands) {
      for (const double component : command.target) ASSERT_TRUE(std::isfinite(component)) << text;
      const Vector2 to{command.target[X], command.target[Y]};
      if (command.kind == CommandKind::arc) {
        ASSERT_GT(command.arc.sweep, 0) << text;
        ASSERT_LT(command.arc.sweep, 361) << text;
        // The end is the start turned by the sweep. R words are exact to 5e-10 at most 70 mm from the centre.
        const Vector2 centre{command.arc.centre[0], command.arc.centre[1]};
        const double angle = (command.arc.clockwise ? -1 : 1) * command.arc.sweep * std::numbers::pi / 180;
        const Vector2 end = centre + std::cos(angle) * (at - centre) + std::sin(angle) * left_of(at - centre);
        ASSERT_NEAR(end.u, to.u, 1e-6) << text;
        ASSERT_NEAR(end.v, to.v, 1e-6) << text;
      }
      at = to;
    }
    ++(result.last == Step::end ? paths : alarms);
  }
  EXPECT_GT(paths, 20);
  EXPECT_GT(alarms, 20);
}

}  // namespace
}  // namespace trunnion::language::test
