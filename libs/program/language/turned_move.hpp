// SPDX-License-Identifier: Apache-2.0
// A straight move with a feed per revolution (G95) while the speed of the spindle follows X (G96): the feed
// of a command is constant, so that the move is given out in pieces.
#pragma once

#include <array>
#include <cstddef>

namespace trunnion::language {

/// Where a move is divided: shares of its way, ascending, above 0 and below 1.
struct Divisions {
  static constexpr std::size_t most = 20;
  std::array<double, most> share{};
  std::size_t count = 0;
};

/// From X = `start` to X = `end`, mm from the centre of the spindle: the speed changes by a tenth in each
/// piece. Nearer to the centre than `limit_radius` (mm, above 0) it is constant. Behind the last division
/// that there is room for, one piece is the rest.
Divisions divide_turned_move(double start, double end, double limit_radius);

}  // namespace trunnion::language
