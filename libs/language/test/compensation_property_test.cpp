// SPDX-License-Identifier: Apache-2.0
// The compensated tool lies at its radius from the contour, never closer.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "language/planar_piece.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

constexpr double radius = 2;

struct Contour {
  std::string text;
  std::vector<PlanarPiece> pieces;
};

std::string words(Vector2 p) {
  char text[80];
  std::snprintf(text, sizeof text, " X%.9f Y%.9f", p.u, p.v);
  return text;
}

// A contour of lines and arcs that always runs forward along X, so that it never meets itself, with corners
// to both sides. Headings stay within 80 degrees of X and every piece is long enough for the tool in any
// corner between two of them: 2 / tan(10 degrees) = 11.3 on either side.
Contour random_contour(std::mt19937_64& random, int pieces, bool arcs) {
  std::uniform_real_distribution<double> heading(-80, 80);
  std::uniform_real_distribution<double> size(30, 60);
  Contour contour;
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
    if (piece.arc) {
      const Vector2 to_centre = piece.centre - at;
      char centre[80];
      std::snprintf(centre, sizeof centre, " I%.9f J%.9f\n", to_centre.u, to_centre.v);
      contour.text += std::string(piece.sweep > 0 ? "G3" : "G2") + words(piece.end) + centre;
    } else {
      contour.text += "G1" + words(piece.end) + "\n";
    }
    contour.pieces.push_back(piece);
    at = piece.end;
  }
  return contour;
}

double distance_from(Vector2 p, const PlanarPiece& piece) {
  const auto away = [&](Vector2 q) { return std::hypot(p.u - q.u, p.v - q.v); };
  double nearest = std::min(away(piece.start), away(piece.end));
  if (!piece.arc) {
    const Vector2 d = piece.end - piece.start;
    const double along = dot(p - piece.start, d) / dot(d, d);
    return along > 0 && along < 1 ? away(piece.start + along * d) : nearest;
  }
  const Vector2 from = piece.start - piece.centre;
  const Vector2 to = p - piece.centre;
  double angle = std::atan2(cross(from, to), dot(from, to));
  if (piece.sweep < 0) angle = -angle;
  if (angle >= 0 && angle <= std::abs(piece.sweep)) {
    nearest = std::min(nearest, std::abs(std::hypot(to.u, to.v) - std::hypot(from.u, from.v)));
  }
  return nearest;
}

double distance_from(Vector2 p, const std::vector<PlanarPiece>& contour) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PlanarPiece& piece : contour) nearest = std::min(nearest, distance_from(p, piece));
  return nearest;
}

/// Points along the commands between the way in and the way out.
std::vector<Vector2> tool_path(const Interpretation& result) {
  std::vector<Vector2> points;
  std::vector<const Command*> moves;
  for (const Command& command : result.commands) {
    if (command.kind == CommandKind::line || command.kind == CommandKind::arc) moves.push_back(&command);
  }
  for (std::size_t i = 1; i + 1 < moves.size(); ++i) {
    const Vector2 a{moves[i - 1]->target[X], moves[i - 1]->target[Y]};
    const Vector2 b{moves[i]->target[X], moves[i]->target[Y]};
    for (int k = 0; k <= 20; ++k) {
      if (moves[i]->kind == CommandKind::line) {
        points.push_back(a + (k / 20.0) * (b - a));
        continue;
      }
      const Arc& arc = moves[i]->arc;
      const Vector2 centre{arc.centre[0], arc.centre[1]};
      const double angle = (arc.clockwise ? -1 : 1) * arc.sweep * (k / 20.0) * std::numbers::pi / 180;
      points.push_back(centre + std::cos(angle) * (a - centre) + std::sin(angle) * left_of(a - centre));
    }
    points.push_back(b);
  }
  return points;
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

/// A line, two quarter arcs (or a quarter arc and a line) that touch where they turn back, and a line. `off`
/// moves the point where they touch, `up` mirrors it in Y.
std::vector<PlanarPiece> cusp(std::mt19937_64& random, double off, bool up) {
  std::uniform_real_distribution<double> radius_of(7, 30), share(-1, 1);
  const double r1 = radius_of(random), r2 = radius_of(random);
  const bool straight = random() % 3 == 0;
  const double sign = up ? 1 : -1;
  std::vector<PlanarPiece> pieces;
  const auto line = [&](Vector2 from, Vector2 to) {
    PlanarPiece piece;
    piece.start = from, piece.end = to;
    pieces.push_back(piece);
  };
  const auto arc = [&](Vector2 from, Vector2 to, double r) {
    PlanarPiece piece;
    piece.arc = true, piece.start = from, piece.end = to;
    const Vector2 half = 0.5 * (to - from);
    const double away = std::sqrt(r * r - dot(half, half));
    // The centre lies on the side that the walk turns to, and the arc is less than half a circle.
    const double turn = sign;
    piece.centre = from + half + (turn * away / language::length(half)) * left_of(half);
    const Vector2 a = from - piece.centre, b = to - piece.centre;
    piece.sweep = std::atan2(cross(a, b), dot(a, b));
    pieces.push_back(piece);
  };
  const Vector2 tip{r1 + off * share(random), sign * r1 + off * share(random)};
  line({-40, 0}, {0, 0});
  arc({0, 0}, tip, r1 + off);
  if (straight) {
    line(tip, {tip.u, -sign * 20});
    line({tip.u, -sign * 20}, {tip.u + 40, -sign * 20});
  } else {
    arc(tip, {tip.u + r2, tip.v - sign * r2}, r2 + off);
    line({tip.u + r2, tip.v - sign * r2}, {tip.u + r2 + 40, tip.v - sign * r2});
  }
  return pieces;
}

Contour words_of(std::vector<PlanarPiece> pieces) {
  Contour contour;
  for (const PlanarPiece& piece : pieces) {
    if (!piece.arc) {
      contour.text += "G1" + words(piece.end) + "\n";
      continue;
    }
    const Vector2 to_centre = piece.centre - piece.start;
    char centre[80];
    std::snprintf(centre, sizeof centre, " I%.9f J%.9f\n", to_centre.u, to_centre.v);
    contour.text += std::string(piece.sweep > 0 ? "G3" : "G2") + words(piece.end) + centre;
  }
  contour.pieces = std::move(pieces);
  return contour;
}

// Where a contour turns back on itself the tool either does not fit between its sides or goes around its
// edge. It never enters either of them, also when words that are rounded make them cross by micrometres.
TEST(CompensationProperty, ACuspIsNeverCutInto) {
  std::mt19937_64 random(35);
  int paths = 0;
  for (int i = 0; i < 600; ++i) {
    const double off = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-6 : 1e-3;
    Contour contour = words_of(cusp(random, off, i % 2 == 0));
    for (const char* const side : {"G41", "G42"}) {
      TestMachine machine;
      machine.tools[1] = {0, 0, radius, 0};
      machine.cutter.interference_check = false;  // the corner itself must be right
      const Interpretation result =
          run(machine, "G90 F100\nG0 X-60 Y0\n" + std::string(side) + " D1 G1 X-40 Y0\n" + contour.text +
                           "G40 G1 G91 X20\nM30\n");
      ASSERT_EQ(result.last, Step::end) << result.alarm.text.data() << "\n" << side << "\n" << contour.text;
      ++paths;
      for (const Vector2 point : tool_path(result))
        // The sides may cross by twice the displacement.
        ASSERT_GT(distance_from(point, contour.pieces), radius - 4 * off - 1e-6)
            << side << " at " << point.u << " " << point.v << "\n"
            << contour.text;
    }
  }
  EXPECT_EQ(paths, 1200);
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
      std::snprintf(line, sizeof line, kind < 2 ? "G1 X%d Y%d\n" : "G%4$d X%1$d Y%2$d R%3$d\n", value(random),
                    value(random), 40 + value(random), kind);
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
