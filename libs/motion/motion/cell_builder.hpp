// SPDX-License-Identifier: Apache-2.0
// Cuts the curve of the geometry stage into cells and derives their limits from those of the machine axes.
#pragma once

#include "motion/axis_motion.hpp"
#include "motion/blended_path.hpp"
#include "motion/limit_cell.hpp"
#include "motion/limits.hpp"

namespace trunnion::motion {

inline constexpr double highest_override = 1.5;

/// Largest absolute derivatives of the machine axes on a cell.
struct CellRates {
  AxisValues first{}, second{}, third{};
  double curvature = 0;  ///< of the X Y Z curve in the frame of the command, 1/length
};

/// Speed, acceleration and jerk along the path that keep every axis within its limits: with v, a, j along the
/// path an axis has q'v, q''v^2 + q'a, q'''v^3 + 3q''va + q'j. `feed` caps the speed at the highest override.
void limit_cell(LimitCell& cell, const CellRates& rates, const Limits& limits);

/// Path speed at which a rounding with these third derivatives keeps the jerk of the axes.
double join_speed(const AxisValues& turn, double reach, const Limits& limits);

class CellBuilder {
 public:
  /// `chain` may be nullptr and must outlive the builder.
  void start(const ModeLimits& limits, const geometry::Chain* chain, double tool_length);

  /// Appends cells for all of the path that is settled and fits into the ring, which keeps cells from `keep`
  /// on.
  void extend(const BlendedPath& path, CellRing& cells, std::uint64_t keep);

  /// The next cells begin at the coordinate `s` of `block`: for extend() up to its end, for extend_back()
  /// down to its start.
  void resume(std::uint64_t block, double s);

  /// As extend(), for motion backwards: cells for the path before resume()'s place down to the start of the
  /// block `oldest`. Their coordinate is the negative path coordinate, so it grows with the motion. True when
  /// that start is reached.
  bool extend_back(const BlendedPath& path, CellRing& cells, std::uint64_t keep, std::uint64_t oldest);

  std::uint64_t next_block() const { return block_; }

 private:
  PathRates rates_at(const BlendedPath& path, std::uint64_t block, double s, double inside) const;
  double overlap_time(const BlendedPath& path, const LimitCell& before, const LimitCell& after) const;
  LimitCell make(const BlendedPath& path, double from, double to) const;
  double cell_end(const BlendedPath& path, double from, double upto) const;
  double longest(const BlendedPath& path) const;

  ModeLimits limits_;
  const geometry::Chain* chain_ = nullptr;
  double tool_length_ = 0;
  std::uint64_t block_ = 0;
  double at_ = 0;
  bool fresh_ = true;
  bool stop_ = false;  // backwards: motion stops at at_
};

}  // namespace trunnion::motion
