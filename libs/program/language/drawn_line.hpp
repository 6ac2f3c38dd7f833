// SPDX-License-Identifier: Apache-2.0
// Lines of which the drawing gives the angle: `,A` degrees from the first axis of the plane, anticlockwise.
#pragma once

#include <cstdint>
#include <optional>

#include "language/corner.hpp"
#include "language/planar_piece.hpp"

namespace trunnion::language {

/// A straight line without ends through a point of a plane. It has an inclination and no direction: 30 and
/// 210 degrees are one line.
class DrawnLine {
 public:
  /// Quarter turns are exact.
  DrawnLine(Vector2 point, double degrees);

  /// Its point with this coordinate along the first or the second axis of the plane, mm; nothing when the
  /// line is parallel to the other axis, as far as 0.0001 degrees.
  std::optional<Vector2> at_first(double u) const;
  std::optional<Vector2> at_second(double v) const;
  /// Where it meets `other`; nothing when the two are parallel, likewise.
  std::optional<Vector2> meets(const DrawnLine& other) const;
  /// mm, of `point` from the line.
  double distance(Vector2 point) const;

 private:
  Vector2 point_;
  Vector2 direction_;  // of length 1
};

/// How a move is made, of a ModalState.
struct MoveModes {
  double feed = 0;
  FeedMode feed_mode = FeedMode::per_minute;
  PathControl path_control = PathControl::continuous;
  double path_tolerance = 0;
  std::uint8_t smoothing = 0;

  static MoveModes of(const ModalState& modal);
  void give_to(ModalState& modal) const;
};

/// A block with `,A` and no coordinate: its line ends where that of the next move begins.
struct OpenLine {
  double degrees = 0;
  std::optional<Corner> corner;  ///< what the block asks for at its end
  std::uint32_t program = 0;     ///< as Command::program
  std::uint32_t line = 0;
  std::uint32_t frame = 0;  ///< revision of the frame of its words
  Plane plane = Plane::xy;
  CutterSide side = CutterSide::off;
  MoveModes modes;
};

}  // namespace trunnion::language
