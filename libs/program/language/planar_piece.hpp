// SPDX-License-Identifier: Apache-2.0
// Lines and circles in a plane: the geometry of cutter radius compensation.
#pragma once

#include <array>
#include <cstddef>

#include "language/canonical.hpp"

namespace trunnion::language {

/// A move shorter than this (mm, degrees) is rounding, not motion.
constexpr double no_distance = 1e-9;

/// A point or a direction, mm.
struct Vector2 {
  double u = 0;
  double v = 0;
  friend Vector2 operator+(Vector2 a, Vector2 b) { return {a.u + b.u, a.v + b.v}; }
  friend Vector2 operator-(Vector2 a, Vector2 b) { return {a.u - b.u, a.v - b.v}; }
  friend Vector2 operator*(double s, Vector2 a) { return {s * a.u, s * a.v}; }
};

double dot(Vector2 a, Vector2 b);
double cross(Vector2 a, Vector2 b);
double length(Vector2 a);
/// `a` turned by a quarter anticlockwise: the left of a direction.
Vector2 left_of(Vector2 a);

/// A straight line or an arc from `start` to `end`, as it is walked.
struct PlanarPiece {
  bool arc = false;
  Vector2 start;
  Vector2 end;
  Vector2 centre;    ///< of an arc
  double sweep = 0;  ///< radians, > 0 anticlockwise, < 0 clockwise; beyond a full turn for several

  /// Directions of the walk, of length 1.
  Vector2 tangent_at_start() const;
  Vector2 tangent_at_end() const;
  /// The end points moved `distance` to the left of the walk.
  Vector2 left_of_start(double distance) const;
  Vector2 left_of_end(double distance) const;
  double length() const;
  /// 1/mm, > 0 to the left of the walk; 0 of a line.
  double curvature() const;
};

/// The move `command` of kind rapid, line or arc, from `start`, in the plane; radii and angles as in Command.
PlanarPiece planar_piece(const Command& command, const AxisValues& start, PlaneAxes plane);
Vector2 in_plane(const AxisValues& position, PlaneAxes plane);

/// What is known about a meeting of two pieces that are moved to their left.
struct Meeting {
  bool found = false;
  bool shortens = false;  ///< it lies before the end of the first piece and behind the start of the second
  Vector2 point;
};

/// Where the line or circle of `first`, moved `first_left` to its left, meets that of `second`, moved
/// `second_left`. Both continue beyond their ends. Of two meetings it is the nearest to the end of `first` of
/// those that shorten both pieces, or the nearest when none does. At an arc the radius is that of the end in
/// question, for it may differ from the other one a little.
Meeting meet(const PlanarPiece& first, double first_left, const PlanarPiece& second, double second_left);

/// The smallest distance between two pieces, mm; 0 where they cross.
double distance(const PlanarPiece& a, const PlanarPiece& b);

}  // namespace trunnion::language
