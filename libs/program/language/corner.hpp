// SPDX-License-Identifier: Apache-2.0
// Chamfers and rounded corners between two moves in a plane.
#pragma once

#include <cstdint>

#include "language/alarms.hpp"
#include "language/planar_piece.hpp"

namespace trunnion::language {

/// What a block asks for at its end: `,C` a chamfer that begins and ends `size` mm from the corner, `,R` an
/// arc of the radius `size` that is tangential to both moves.
struct Corner {
  enum class Kind : std::uint8_t { chamfer, rounding };
  Kind kind = Kind::chamfer;
  double size = 0;  ///< mm, above 0
};

/// Both moves, shortened, and what is between them.
struct CutCorner {
  AlarmNumber alarm = AlarmNumber::none;
  bool inserted = false;  ///< false: the moves are tangential, nothing is to be rounded
  PlanarPiece first, between, second;
};

/// `first` ends where `second` starts; both have a length. A chamfer needs two lines. Alarms:
/// corner_chamfer_arc, corner_too_large (it would begin before `first` or end behind `second`, or the second
/// turns straight back).
CutCorner cut_corner(const PlanarPiece& first, const PlanarPiece& second, const Corner& corner);

}  // namespace trunnion::language
