// SPDX-License-Identifier: Apache-2.0
// A section of the path with its limits of path speed, acceleration and jerk.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "motion/transition.hpp"

namespace trunnion::motion {

/// Lengths of path that rounding may add, mm or degrees.
constexpr double rounding_distance = 2e-9;
/// What computing speed, acceleration and jerk may add to a limit, as a share of it.
constexpr double relative_rounding = 1e-7;

/// One machine axis on a cell: first to third derivative by the path length at both ends, between which they
/// are interpolated, and its limits.
struct AxisOnCell {
  std::array<float, 3> begin{}, end{};
  float acceleration = 0, jerk = 0;
};

/// Every axis keeps its limits on the cell for any motion with 0 <= v <= speeds[k], |a| and |j| within
/// ramps[k]. Level 0 is the fastest; slower levels leave more to acceleration and jerk.
struct LimitCell {
  static constexpr std::size_t levels = 4;
  /// Speeds of the levels as shares of the first.
  static constexpr std::array<double, levels> shares{1, 0.85, 0.65, 0.4};

  double at = 0;     ///< path coordinate of the start
  double end = 0;    ///< and of the end
  double speed = 0;  ///< never exceeded, whatever the override
  double feed = 0;   ///< programmed speed at override 1
  std::array<RampLimits, levels> ramps{};
  double top =
      0;  ///< highest speed that the axes themselves allow; from `speed` to it only keeps_axes() decides
  static constexpr std::size_t most_axes = 6;
  std::array<AxisOnCell, most_axes> axes{};
  int axis_count = 0;    ///< of arcs, whose axes are checked one by one; 0: only the ramps decide
  int known_axes = 0;    ///< `axes` that move; 0: too many do
  double reachable = 0;  ///< highest speed by the velocities of the axes alone
  bool dense = false;    ///< of a short move, or of a piece of the curve that replaces some
  bool rapid = false;
  bool uniform = false;         ///< all levels are the same
  bool stop = false;            ///< motion stops at the start
  int wait_cycles = 0;          ///< standstill there
  bool position_check = false;  ///< which ends as soon as the axes are in position
  double overlap = 0;           ///< s; motion may leave the start this long before it has been reached
  std::uint64_t block = 0;

  /// Ramp limits up to the speed v.
  const RampLimits& ramp(double v) const {
    std::size_t k = levels - 1;
    while (k > 0 && v > shares[k] * speed) --k;
    return ramps[k];
  }
  /// A level counts as reached at this share of its speed: on a curve each cell's level may be a little
  /// faster than that of the one before, and would never be.
  static constexpr double reached_share = 0.99;
  /// Speed of the slowest level above v that v has not reached.
  double level_speed(double v) const {
    std::size_t k = levels - 1;
    while (k > 0 && v >= reached_share * shares[k] * speed) --k;
    return shares[k] * speed;
  }
};

/// Where `s` is on the cell: 0 at its start to 1 at its end.
inline double part_of(const LimitCell& cell, double s) {
  const double length = cell.end - cell.at;
  return length > 0 ? std::clamp((s - cell.at) / length, 0.0, 1.0) : 0.0;
}

/// Ring of cells addressed by a counter that never wraps.
class CellRing {
 public:
  static constexpr std::uint64_t capacity = 32768;
  CellRing() : cells_(capacity) {}
  LimitCell& operator[](std::uint64_t index) { return cells_[index % capacity]; }
  const LimitCell& operator[](std::uint64_t index) const { return cells_[index % capacity]; }
  std::uint64_t size() const { return pushed_; }
  void clear() { pushed_ = 0; }
  void push(const LimitCell& cell) { (*this)[pushed_++] = cell; }
  /// `count` cells behind the last one have been written in place.
  void append(std::uint64_t count) { pushed_ += count; }

 private:
  std::vector<LimitCell> cells_;
  std::uint64_t pushed_ = 0;
};

}  // namespace trunnion::motion
