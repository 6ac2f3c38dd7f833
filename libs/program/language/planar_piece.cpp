// SPDX-License-Identifier: Apache-2.0
#include "language/planar_piece.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trunnion::language {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

double distance_from_segment(Vector2 p, Vector2 a, Vector2 b) {
  const Vector2 d = b - a;
  const double square = dot(d, d);
  const double along = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0.0;
  return length(p - (a + along * d));
}

/// True when the arc passes the direction of `p` from its centre.
bool passes(const PlanarPiece& arc, Vector2 p) {
  if (std::abs(arc.sweep) >= full_turn) return true;
  const Vector2 from = arc.start - arc.centre;
  const Vector2 to = p - arc.centre;
  double angle = std::atan2(cross(from, to), dot(from, to));
  if (arc.sweep < 0) angle = -angle;
  if (angle < 0) angle += full_turn;
  return angle <= std::abs(arc.sweep);
}

double distance_from_arc(Vector2 p, const PlanarPiece& arc) {
  double nearest = std::min(length(p - arc.start), length(p - arc.end));
  const double from_centre = length(p - arc.centre);
  const double radius = length(arc.start - arc.centre);
  // From the centre itself every point of the arc is equally far.
  if (from_centre == 0 || passes(arc, p)) nearest = std::min(nearest, std::abs(from_centre - radius));
  return nearest;
}

double distance_from(Vector2 p, const PlanarPiece& piece) {
  return piece.arc ? distance_from_arc(p, piece) : distance_from_segment(p, piece.start, piece.end);
}

struct Points {
  std::array<Vector2, 2> at;
  std::size_t count = 0;
};

Points line_and_circle(Vector2 p, Vector2 direction, Vector2 centre, double radius) {
  const Vector2 from = p - centre;
  const double along = -dot(from, direction);
  const Vector2 foot = p + along * direction;
  const double away = length(foot - centre);
  if (away > radius) return {};
  const double half = std::sqrt((radius - away) * (radius + away));
  return {{foot + half * direction, foot - half * direction}, 2};
}

Points two_circles(Vector2 a, double ra, Vector2 b, double rb) {
  const Vector2 d = b - a;
  const double between = length(d);
  if (!(between > 0) || between > ra + rb || between < std::abs(ra - rb)) return {};
  const double along = (between * between + (ra - rb) * (ra + rb)) / (2 * between);
  const double square = (ra - along) * (ra + along);
  const double half = square > 0 ? std::sqrt(square) : 0.0;
  const Vector2 unit = (1 / between) * d;
  const Vector2 foot = a + along * unit;
  return {{foot + half * left_of(unit), foot - half * left_of(unit)}, 2};
}

Points crossings(const PlanarPiece& a, const PlanarPiece& b) {
  if (a.arc && b.arc) {
    return two_circles(a.centre, length(a.start - a.centre), b.centre, length(b.start - b.centre));
  }
  const PlanarPiece& line = a.arc ? b : a;
  const PlanarPiece& arc = a.arc ? a : b;
  return line_and_circle(line.start, line.tangent_at_start(), arc.centre, length(arc.start - arc.centre));
}

bool on_line(const PlanarPiece& line, Vector2 p) {
  const Vector2 d = line.end - line.start;
  const double along = dot(p - line.start, d);
  return along >= 0 && along <= dot(d, d);
}

bool within(const PlanarPiece& piece, Vector2 p) { return piece.arc ? passes(piece, p) : on_line(piece, p); }

bool lines_cross(const PlanarPiece& a, const PlanarPiece& b) {
  const Vector2 da = a.end - a.start;
  const Vector2 db = b.end - b.start;
  const double turn = cross(da, db);
  if (turn == 0) return false;
  const double along_a = cross(b.start - a.start, db) / turn;
  const double along_b = cross(b.start - a.start, da) / turn;
  return along_a >= 0 && along_a <= 1 && along_b >= 0 && along_b <= 1;
}

/// How far `p` lies along the walk behind `at`, an end of the piece: mm on a line, radians on an arc.
double along(const PlanarPiece& piece, Vector2 at, Vector2 direction, Vector2 p) {
  if (!piece.arc) return dot(p - at, direction);
  const Vector2 from = at - piece.centre;
  const Vector2 to = p - piece.centre;
  const double angle = std::atan2(cross(from, to), dot(from, to));
  return piece.sweep > 0 ? angle : -angle;
}

}  // namespace

double dot(Vector2 a, Vector2 b) { return a.u * b.u + a.v * b.v; }
double cross(Vector2 a, Vector2 b) { return a.u * b.v - a.v * b.u; }
double length(Vector2 a) { return std::hypot(a.u, a.v); }
Vector2 left_of(Vector2 a) { return {-a.v, a.u}; }

Vector2 in_plane(const AxisValues& position, PlaneAxes plane) {
  return {position[plane.first], position[plane.second]};
}

PlanarPiece planar_piece(const Command& command, const AxisValues& start, PlaneAxes plane) {
  PlanarPiece piece;
  piece.arc = command.kind == CommandKind::arc;
  piece.start = in_plane(start, plane);
  piece.end = in_plane(command.target, plane);
  if (!piece.arc) return piece;
  const Arc& arc = command.arc;
  piece.centre = {arc.centre[plane.first], arc.centre[plane.second]};
  piece.sweep = arc.sweep * std::numbers::pi / 180 * (arc.clockwise ? -1 : 1);
  return piece;
}

Vector2 PlanarPiece::tangent_at_start() const {
  const Vector2 d = arc ? (sweep > 0 ? 1.0 : -1.0) * left_of(start - centre) : end - start;
  return (1 / language::length(d)) * d;
}

Vector2 PlanarPiece::tangent_at_end() const {
  const Vector2 d = arc ? (sweep > 0 ? 1.0 : -1.0) * left_of(end - centre) : end - start;
  return (1 / language::length(d)) * d;
}

Vector2 PlanarPiece::left_of_start(double distance) const {
  return start + distance * left_of(tangent_at_start());
}

Vector2 PlanarPiece::left_of_end(double distance) const { return end + distance * left_of(tangent_at_end()); }

double PlanarPiece::curvature() const {
  return arc ? (sweep > 0 ? 1.0 : -1.0) / language::length(end - centre) : 0.0;
}

double PlanarPiece::length() const {
  if (!arc) return language::length(end - start);
  return std::abs(sweep) * 0.5 * (language::length(start - centre) + language::length(end - centre));
}

Meeting meet(const PlanarPiece& first, double first_left, const PlanarPiece& second, double second_left) {
  // The left of an anticlockwise arc is its inside.
  const auto circle = [](const PlanarPiece& arc, Vector2 at, double left) {
    return length(at - arc.centre) + (arc.sweep > 0 ? -left : left);
  };
  Points points;
  if (first.arc && second.arc) {
    points = two_circles(first.centre, circle(first, first.end, first_left), second.centre,
                         circle(second, second.start, second_left));
  } else if (first.arc) {
    points = line_and_circle(second.left_of_start(second_left), second.tangent_at_start(), first.centre,
                             circle(first, first.end, first_left));
  } else if (second.arc) {
    points = line_and_circle(first.left_of_end(first_left), first.tangent_at_end(), second.centre,
                             circle(second, second.start, second_left));
  } else {
    const Vector2 a = first.left_of_end(first_left);
    const Vector2 b = second.left_of_start(second_left);
    const Vector2 da = first.tangent_at_end();
    const Vector2 db = second.tangent_at_start();
    const double turn = cross(da, db);
    if (turn == 0) return {};
    points = {{a + (cross(b - a, db) / turn) * da, {}}, 1};
  }
  Meeting best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.count; ++i) {
    const Vector2 p = points.at[i];
    const bool shortens = along(first, first.end, first.tangent_at_end(), p) <= 0 &&
                          along(second, second.start, second.tangent_at_start(), p) >= 0;
    const double away = length(p - first.end);
    if (best.found && (best.shortens != shortens ? best.shortens : away >= least)) continue;
    least = away;
    best = {true, shortens, p};
  }
  return best;
}

double distance(const PlanarPiece& a, const PlanarPiece& b) {
  double nearest = std::min({distance_from(a.start, b), distance_from(a.end, b), distance_from(b.start, a),
                             distance_from(b.end, a)});
  if (!a.arc && !b.arc) return lines_cross(a, b) ? 0.0 : nearest;
  const Points crossing = crossings(a, b);
  for (std::size_t i = 0; i < crossing.count; ++i) {
    if (within(a, crossing.at[i]) && within(b, crossing.at[i])) return 0.0;
  }
  // Between the ends the nearest points lie on the common normal through the centres.
  const PlanarPiece& arc = a.arc ? a : b;
  const PlanarPiece& other = a.arc ? b : a;
  const double radius = length(arc.start - arc.centre);
  if (!other.arc) {
    const Vector2 t = other.tangent_at_start();
    const Vector2 foot = other.start + dot(arc.centre - other.start, t) * t;
    if (on_line(other, foot) && passes(arc, foot)) {
      nearest = std::min(nearest, std::abs(length(foot - arc.centre) - radius));
    }
    return nearest;
  }
  const Vector2 d = other.centre - arc.centre;
  const double between = length(d);
  if (!(between > 0)) return nearest;
  const Vector2 unit = (1 / between) * d;
  const double other_radius = length(other.start - other.centre);
  for (const double side_a : {1.0, -1.0}) {
    for (const double side_b : {1.0, -1.0}) {
      const Vector2 pa = arc.centre + (side_a * radius) * unit;
      const Vector2 pb = other.centre + (side_b * other_radius) * unit;
      if (passes(arc, pa) && passes(other, pb)) nearest = std::min(nearest, length(pa - pb));
    }
  }
  return nearest;
}

}  // namespace trunnion::language
