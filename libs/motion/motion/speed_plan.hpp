// SPDX-License-Identifier: Apache-2.0
// A planned speed along the path, and the motion that follows it.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/transition.hpp"

namespace trunnion::motion {

/// b = v^2 on a stretch of the path, x mm (or degrees) behind its start: b0 + x (b1 + x b2). The acceleration
/// along the path is b' / 2, so the motion on it is x'' = b1 / 2 + b2 x.
struct SpeedPiece {
  double at = 0;      ///< path coordinate of the start
  double length = 0;  ///< above 0
  double b0 = 0, b1 = 0, b2 = 0;

  double end() const { return at + length; }
  double square(double s) const { return b0 + (s - at) * (b1 + (s - at) * b2); }
  double slope(double s) const { return b1 + 2 * (s - at) * b2; }
  /// s about: exact where the acceleration is constant on either half.
  double duration() const;
};

/// Pieces in a row, each continuing speed and acceleration of the one before, and a place on them. Nothing
/// allocates after construction.
class SpeedPlan {
 public:
  static constexpr std::size_t capacity = 512;

  SpeedPlan() { pieces_.reserve(capacity); }

  void clear() { pieces_.clear(), current_ = 0; }
  bool empty() const { return pieces_.empty(); }
  std::size_t size() const { return pieces_.size(); }
  const SpeedPiece& operator[](std::size_t index) const { return pieces_[index]; }
  std::size_t current() const { return current_; }
  double end() const { return pieces_.empty() ? 0 : pieces_.back().end(); }

  /// `pieces` and behind them `last` from the start of the piece `index` on; pieces that have been executed
  /// are dropped. False, and nothing changed, when there is no room.
  bool replace(std::size_t index, const std::vector<SpeedPiece>& pieces, const SpeedPiece& last);

  /// From `state` on the current piece `time` seconds on. At the end of the pieces the time left is not used.
  PathState advance(const PathState& state, double time) { return advance(state, time, current_); }
  /// The same from `state` on the piece `piece`, which is moved along instead of the place.
  PathState advance(const PathState& state, double time, std::size_t& piece) const;
  /// Follows the rest at `rate` (above 0, at most 1) of its speed, from the place on.
  void slow_down(double rate);

 private:
  std::vector<SpeedPiece> pieces_;
  std::size_t current_ = 0;
};

}  // namespace trunnion::motion
