// SPDX-License-Identifier: Apache-2.0
// Random contours that turn back on themselves: the swept tool never enters the side of the material.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "compensation_contour.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

constexpr double largest_tool = 6;
constexpr double from_left = -300;  // where every contour begins, in X

/// What meets where a contour turns back. Nested arcs bend to the same side of the line they touch in.
enum Reversal { line_before_arc, arc_before_line, arcs_apart, nested_arcs, reversal_kinds };

Vector2 place_on(const PlanarPiece& piece, double share) {
  if (!piece.arc) return piece.start + share * (piece.end - piece.start);
  const Vector2 from = piece.start - piece.centre;
  const double angle = share * piece.sweep;
  return piece.centre + std::cos(angle) * from + std::sin(angle) * left_of(from);
}

PlanarPiece straight_piece(Vector2 from, Vector2 to) {
  PlanarPiece piece;
  piece.start = from, piece.end = to;
  return piece;
}

/// From `at` in the direction `heading` (rad), with a radius > 0 to the left, < 0 to the right.
PlanarPiece arc_piece(Vector2 at, double heading, double radius, double way) {
  PlanarPiece piece;
  piece.arc = true;
  piece.start = at;
  piece.centre = at + radius * left_of({std::cos(heading), std::sin(heading)});
  piece.sweep = way / radius;
  piece.end = place_on(piece, 1);
  return piece;
}

/// The arc of the same radius, less than half a turn, through other ends.
PlanarPiece moved_arc(const PlanarPiece& arc, Vector2 from, Vector2 to) {
  PlanarPiece piece = arc;
  const double radius = length(arc.start - arc.centre);
  const Vector2 half = 0.5 * (to - from);
  const double away = std::sqrt(radius * radius - dot(half, half));
  piece.start = from, piece.end = to;
  piece.centre = from + half + (std::copysign(away, arc.sweep) / length(half)) * left_of(half);
  const Vector2 a = from - piece.centre, b = to - piece.centre;
  piece.sweep = std::atan2(cross(a, b), dot(a, b));
  return piece;
}

/// True when each of two neighbours gets farther from the other all the way from where they meet: then the
/// tool fits everywhere beyond the first place at which it fits between them.
bool separate(const PlanarPiece& before, const PlanarPiece& after) {
  double gone = 0, come = 0;
  for (int k = 1; k <= 100; ++k) {
    const double next = distance_from(place_on(after, k / 100.0), before);
    const double back = distance_from(place_on(before, 1 - k / 100.0), after);
    if (next < gone || back < come) return false;
    gone = next, come = back;
  }
  return true;
}

bool keeps_clear(const PlanarPiece& piece, const std::vector<PlanarPiece>& others) {
  for (int k = 0; k <= 100; ++k) {
    const Vector2 p = place_on(piece, k / 100.0);
    for (const PlanarPiece& other : others)
      if (distance_from(p, other) < 2 * largest_tool + 1) return false;
  }
  return true;
}

struct CuspContour {
  std::vector<PlanarPiece> pieces;
  std::vector<std::size_t> reversals;  // of pieces that turn back at their start
  std::array<int, reversal_kinds> kinds{};
};

// Straight from far on the left, some lines and arcs with reversals between them, straight far to the right.
// Only neighbours come near each other.
class ContourMaker {
 public:
  explicit ContourMaker(std::mt19937_64& random) : random_(random) {}

  CuspContour make() {
    while (true) {
      CuspContour contour;
      contour.pieces.push_back(straight_piece({from_left, 0}, {0, 0}));
      double heading = 0;
      for (int tries = 0; tries < 300 && contour.pieces.size() < 9; ++tries) extend(contour, heading);
      const Vector2 at = contour.pieces.back().end;
      const PlanarPiece out = straight_piece(at, {std::max(at.u, 0.0) + 600, at.v});
      if (contour.pieces.size() < 9 || std::abs(heading) > 1.7 || !fits(contour, out)) continue;
      contour.pieces.push_back(out);
      return contour;
    }
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  static bool fits(const CuspContour& contour, const PlanarPiece& piece) {
    const auto& pieces = contour.pieces;
    return separate(pieces.back(), piece) && keeps_clear(piece, {pieces.begin(), pieces.end() - 1});
  }

  void extend(CuspContour& contour, double& heading) {
    const bool back = random_() % 2 == 0;
    const double begin = back ? heading + std::numbers::pi : heading + between(-1.7, 1.7);
    const Vector2 at = contour.pieces.back().end;
    PlanarPiece piece = straight_piece(at, at + between(15, 60) * Vector2{std::cos(begin), std::sin(begin)});
    double turned = 0;
    if (random_() % 3 != 0) {
      const double radius = between(7, 40);
      turned = std::copysign(between(0.4, 2.4), between(-1, 1));
      piece = arc_piece(at, begin, std::copysign(radius, turned), radius * std::abs(turned));
      turned = piece.sweep;
    }
    if (!fits(contour, piece)) return;
    if (back) {
      const PlanarPiece& before = contour.pieces.back();
      const bool one_sense = (before.sweep > 0) == (piece.sweep > 0);
      if (!before.arc && !piece.arc) return;
      ++contour.kinds[!before.arc  ? line_before_arc
                      : !piece.arc ? arc_before_line
                      : one_sense  ? arcs_apart
                                   : nested_arcs];
      contour.reversals.push_back(contour.pieces.size());
    }
    contour.pieces.push_back(piece);
    heading = std::remainder(begin + turned, 2 * std::numbers::pi);
  }

  std::mt19937_64& random_;
};

/// Moves the places where the contour turns back by up to `off` in X and in Y.
void disturb(CuspContour& contour, double off, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(-off, off);
  for (const std::size_t k : contour.reversals) {
    PlanarPiece &before = contour.pieces[k - 1], &after = contour.pieces[k];
    const Vector2 tip = before.end + Vector2{share(random), share(random)};
    before = before.arc ? moved_arc(before, before.start, tip) : straight_piece(before.start, tip);
    after = after.arc ? moved_arc(after, tip, after.end) : straight_piece(tip, after.end);
  }
}

/// How often the contour, closed far away on its left, goes around `p`: once on its left, not on its right.
long turns_around(Vector2 p, const std::vector<PlanarPiece>& contour) {
  double angle = 0;
  Vector2 at = contour.front().start;
  const auto go = [&](Vector2 to) {
    angle += std::atan2(cross(at - p, to - p), dot(at - p, to - p));
    at = to;
  };
  for (const PlanarPiece& piece : contour) {
    // The chords of a radius of 40 mm lie 1 um beside it, far less than the tool's radius.
    const int count = piece.arc ? 160 : 1;
    for (int k = 1; k <= count; ++k) go(place_on(piece, static_cast<double>(k) / count));
  }
  constexpr double far = 5000;
  for (const Vector2 corner : {Vector2{far, at.v}, {far, far}, {-far, far}, {-far, 0}, {from_left, 0}})
    go(corner);
  return std::lround(angle / (2 * std::numbers::pi));
}

class CompensationCusp : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(displaced, CompensationCusp, ::testing::Values(0, 1e-6, 1e-3));

// Where a contour turns back on itself the tool either does not fit between its sides, which is an alarm, or
// goes around its edge. It never enters the material, also when words that are rounded make both sides cross
// by micrometres.
TEST_P(CompensationCusp, IsNeverCutInto) {
  const double off = GetParam();
  std::mt19937_64 random(static_cast<std::uint64_t>(1e9 * off) + 36);
  ContourMaker maker(random);
  std::array<int, reversal_kinds> kinds{};
  int paths = 0;
  for (int i = 0; i < 50; ++i) {
    CuspContour made = maker.make();
    disturb(made, off, random);
    const Contour contour = words_of(made.pieces);
    const double radius = std::uniform_real_distribution<double>(1, largest_tool)(random);
    for (const bool left : {true, false}) {
      TestMachine machine;
      machine.tools[1] = {0, 0, radius, 0};
      machine.cutter.interference_check = false;  // the corner itself must be right
      const Interpretation result =
          run(machine, "G90 F100\nG0 X-320 Y0\n" + std::string(left ? "G41" : "G42") + " D1 G1 X-300 Y0\n" +
                           contour.text + "G40 G1 G91 X20\nM30\n");
      if (result.last != Step::end) continue;
      ++paths;
      for (std::size_t k = 0; k < kinds.size(); ++k) kinds[k] += made.kinds[k];
      int number = 0;
      for (const Vector2 point : tool_path(result)) {
        // The sides may cross by twice the displacement, in X and in Y.
        ASSERT_GT(distance_from(point, contour.pieces), radius - 4 * off - 1e-6)
            << "radius " << radius << (left ? " left" : " right") << " at " << point.u << " " << point.v
            << "\n"
            << contour.text;
        if (number++ % 16 != 0) continue;  // a tool that changed the side would have crossed the contour
        ASSERT_EQ(turns_around(point, contour.pieces), left ? 1 : 0)
            << "radius " << radius << " at " << point.u << " " << point.v << "\n"
            << contour.text;
      }
    }
  }
  EXPECT_GT(paths, 25);
  for (const int count : kinds) EXPECT_GT(count, 0) << "every kind of reversal";
}

}  // namespace
}  // namespace trunnion::language::test
