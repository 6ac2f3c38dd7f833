// SPDX-License-Identifier: Apache-2.0
// How far setpoints lie from the programmed path, by searching the nearest point of it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "language/canonical.hpp"

namespace trunnion::analysis {

using language::AxisValues;

struct Deviation {
  double contour = 0;      ///< mm, of X Y Z in the frame of the commands
  double orientation = 0;  ///< degrees, of A B C together
};

/// Keeps a programmed path of lines and arcs and compares positions with it.
class ContourCheck {
 public:
  /// The two tolerances weigh distance against orientation when the nearest point is looked for; above 0.
  ContourCheck(const AxisValues& start, double contour_tolerance, double orientation_tolerance);

  /// Appends a rapid, line or arc; other kinds are left out.
  void add(const language::Command& command);
  /// Another path begins at `start`: the frame was changed.
  void jump(const AxisValues& start) { end_ = start; }

  /// Deviation of a position sent while the command with `sequence` was executed: only the path within
  /// `reach` mm (or degrees) before and behind that command is searched.
  Deviation of(const AxisValues& position, std::uint32_t sequence, double reach = 5) const;

  /// Commands before `sequence` will not be asked for again: what lies more than `reach` before it is
  /// dropped.
  void forget(std::uint32_t sequence, double reach = 5);

  std::size_t size() const { return pieces_.size(); }

 private:
  /// An arc, helix or spiral: in the plane (u, v), rising along `normal`.
  struct Circle {
    std::size_t u = 0, v = 1, normal = 2;
    double centre_u = 0, centre_v = 0;
    double radius = 0, growth = 0;  ///< at the start, and what the end has more
    double angle = 0, sweep = 0;    ///< radians, > 0 anticlockwise
  };
  struct Piece {
    AxisValues start{}, target{};
    std::optional<Circle> circle;  ///< nothing: a line
    bool turns = false;            ///< the orientation changes along it
    std::uint32_t sequence = 0;
    double size = 0;
  };
  static Circle circle_of(const Piece& piece, const language::Arc& arc);
  static double nearest_possible(const Piece& piece, const AxisValues& position);
  static double foot_on_line(const Piece& piece, const AxisValues& position);
  double foot_on_arc(const Piece& piece, double f, const AxisValues& position) const;
  AxisValues at(const Piece& piece, double f) const;
  double weigh(const Piece& piece, double f, const AxisValues& position, Deviation& deviation) const;
  double search(const Piece& piece, const AxisValues& position, Deviation& deviation) const;
  double search(const Piece& piece, double low, double high, const AxisValues& position,
                Deviation& deviation) const;
  double search_arc(const Piece& piece, const AxisValues& position, Deviation& deviation) const;

  std::vector<Piece> pieces_;
  std::size_t kept_ = 0;  // pieces after the last forget()
  AxisValues end_;
  double contour_tolerance_, orientation_tolerance_;
};

}  // namespace trunnion::analysis
