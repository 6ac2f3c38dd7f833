// SPDX-License-Identifier: Apache-2.0
// How far setpoints lie from the programmed path, by searching the nearest point of it.
#pragma once

#include <cstddef>
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
  struct Piece {
    AxisValues start{}, target{};
    language::Arc arc{};
    bool is_arc = false;
    std::uint32_t sequence = 0;
    double size = 0;
  };
  AxisValues at(const Piece& piece, double f) const;
  double weigh(const Piece& piece, double f, const AxisValues& position, Deviation& deviation) const;
  double search(const Piece& piece, const AxisValues& position, Deviation& deviation) const;
  double search(const Piece& piece, double low, double high, const AxisValues& position,
                Deviation& deviation) const;

  std::vector<Piece> pieces_;
  std::size_t kept_ = 0;  // pieces after the last forget()
  AxisValues end_;
  double contour_tolerance_, orientation_tolerance_;
};

}  // namespace trunnion::analysis
