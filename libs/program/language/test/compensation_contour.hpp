// SPDX-License-Identifier: Apache-2.0
// Contours in a plane as words of a program, and how far the tool of its commands is from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "language/planar_piece.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {

struct Contour {
  std::string text;
  std::vector<PlanarPiece> pieces;
};

inline std::string words(Vector2 p) {
  char text[80];
  std::snprintf(text, sizeof text, " X%.9f Y%.9f", p.u, p.v);
  return text;
}

inline Contour words_of(std::vector<PlanarPiece> pieces) {
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

inline double distance_from(Vector2 p, const PlanarPiece& piece) {
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

inline double distance_from(Vector2 p, const std::vector<PlanarPiece>& contour) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PlanarPiece& piece : contour) nearest = std::min(nearest, distance_from(p, piece));
  return nearest;
}

/// Points along the commands between the way in and the way out, at most 0.25 mm apart.
inline std::vector<Vector2> tool_path(const Interpretation& result) {
  std::vector<Vector2> points;
  std::vector<const Command*> moves;
  for (const Command& command : result.commands) {
    if (command.kind == CommandKind::line || command.kind == CommandKind::arc) moves.push_back(&command);
  }
  for (std::size_t i = 1; i + 1 < moves.size(); ++i) {
    const Vector2 a{moves[i - 1]->target[X], moves[i - 1]->target[Y]};
    const Vector2 b{moves[i]->target[X], moves[i]->target[Y]};
    const Arc& arc = moves[i]->arc;
    const Vector2 centre{arc.centre[0], arc.centre[1]};
    const double turn = (arc.clockwise ? -1 : 1) * arc.sweep * std::numbers::pi / 180;
    const bool straight = moves[i]->kind == CommandKind::line;
    const double way = straight ? length(b - a) : std::abs(turn) * length(a - centre);
    const int count = std::max(20, static_cast<int>(std::ceil(way / 0.25)));
    for (int k = 0; k <= count; ++k) {
      const double share = static_cast<double>(k) / count;
      if (straight) {
        points.push_back(a + share * (b - a));
        continue;
      }
      const double angle = share * turn;
      points.push_back(centre + std::cos(angle) * (a - centre) + std::sin(angle) * left_of(a - centre));
    }
    points.push_back(b);
  }
  return points;
}

}  // namespace trunnion::language::test
