// SPDX-License-Identifier: Apache-2.0
// A motion along the path as phases of constant jerk, and the proof that it keeps the limits of the cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/limit_cell.hpp"
#include "motion/transition.hpp"

namespace trunnion::motion {

/// Phases one after the other, at most `capacity`.
class PhaseList {
 public:
  static constexpr std::size_t capacity = 256;

  void clear() { count_ = 0; }
  std::size_t size() const { return count_; }
  const JerkPhase& operator[](std::size_t index) const { return phases_[index]; }
  /// False when the list is full.
  bool add(const JerkPhase& phase);
  /// The first `time` seconds of a transition, all of it when that is shorter, followed by rest or cruise of
  /// what is left of a finite `time`.
  bool add(const Transition& transition, double time);
  bool add(const Transition& transition);
  bool add(const PhaseList& other);

  /// `state` after all phases.
  PathState after(PathState state) const;
  /// Takes the first `time` seconds away and returns the state after them; behind the end the state stays.
  PathState advance(PathState state, double time);

 private:
  std::array<JerkPhase, capacity> phases_{};
  std::size_t count_ = 0;
};

/// True when the motion from `state` on cell `cell` keeps speed, acceleration and jerk of every cell it runs
/// over and ends on the path known before the next stop. Speeds and accelerations are bounded over short
/// slices of time and compared with all cells a slice touches, so nothing between two samples is missed.
/// Moves `cell` along.
bool keeps_limits(const PhaseList& phases, PathState state, const CellRing& cells, std::uint64_t& cell);

}  // namespace trunnion::motion
