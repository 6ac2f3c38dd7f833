// SPDX-License-Identifier: Apache-2.0
#include "language/corner.hpp"

#include <cmath>
#include <numbers>

namespace trunnion::language {
namespace {

// Directions that differ by less (rad) are one direction.
constexpr double tangential = 1e-9;

// From direction `a` to direction `b`, in the sense of `sweep`: 0 .. 2 pi, a whole turn less rounding counts
// as none.
double turn(Vector2 a, Vector2 b, double sweep) {
  double angle = std::atan2(cross(a, b), dot(a, b)) * (sweep > 0 ? 1 : -1);
  if (angle < 0) angle += 2 * std::numbers::pi;
  return angle;
}

// The nearest point of the line or circle of `piece`.
Vector2 foot(const PlanarPiece& piece, Vector2 p) {
  if (!piece.arc) {
    const Vector2 t = piece.tangent_at_start();
    return piece.start + dot(p - piece.start, t) * t;
  }
  const Vector2 from = p - piece.centre;
  return piece.centre + (length(piece.start - piece.centre) / length(from)) * from;
}

// The piece up to `at`, or from there on; false when `at` is not between its ends.
bool end_at(PlanarPiece& piece, Vector2 at) {
  if (piece.arc) {
    const double left = turn(at - piece.centre, piece.end - piece.centre, piece.sweep);
    const double rest = std::abs(piece.sweep) - left;
    if (rest < -no_distance) return false;
    piece.sweep = std::copysign(rest, piece.sweep);
  } else if (dot(at - piece.start, piece.tangent_at_start()) < -no_distance) {
    return false;
  }
  piece.end = at;
  return true;
}

bool start_at(PlanarPiece& piece, Vector2 at) {
  if (piece.arc) {
    const double rest =
        std::abs(piece.sweep) - turn(piece.start - piece.centre, at - piece.centre, piece.sweep);
    if (rest < -no_distance) return false;
    piece.sweep = std::copysign(rest, piece.sweep);
  } else if (dot(piece.end - at, piece.tangent_at_start()) < -no_distance) {
    return false;
  }
  piece.start = at;
  return true;
}

}  // namespace

CutCorner cut_corner(const PlanarPiece& first, const PlanarPiece& second, const Corner& corner) {
  CutCorner cut{AlarmNumber::none, true, first, {}, second};
  // The corner before may have used it up: it has no direction.
  if (!(first.length() > no_distance) || !(second.length() > no_distance)) {
    cut.alarm = AlarmNumber::corner_too_large;
    return cut;
  }
  const Vector2 in = first.tangent_at_end(), out = second.tangent_at_start();
  const double side = cross(in, out);
  if (corner.kind == Corner::Kind::chamfer) {
    if (first.arc || second.arc) {
      cut.alarm = AlarmNumber::corner_chamfer_arc;
      return cut;
    }
    cut.between.start = first.end - corner.size * in;
    cut.between.end = first.end + corner.size * out;
  } else {
    if (std::abs(side) < tangential && dot(in, out) > 0) {
      cut.inserted = false;
      return cut;
    }
    const double left = side > 0 ? corner.size : -corner.size;
    const Meeting centre = meet(first, left, second, left);
    if (!centre.found || !centre.shortens) {
      cut.alarm = AlarmNumber::corner_too_large;
      return cut;
    }
    PlanarPiece& arc = cut.between;
    arc.arc = true;
    arc.centre = centre.point;
    arc.start = foot(first, centre.point);
    arc.end = foot(second, centre.point);
    arc.sweep = std::copysign(turn(arc.start - arc.centre, arc.end - arc.centre, left), left);
  }
  if (!end_at(cut.first, cut.between.start) || !start_at(cut.second, cut.between.end) ||
      length(cut.between.end - cut.between.start) < no_distance)
    cut.alarm = AlarmNumber::corner_too_large;
  return cut;
}

}  // namespace trunnion::language
