// SPDX-License-Identifier: Apache-2.0
// Compares the output of a stage's shadow with that of the stage, in any order of arrival.
#pragma once

#include <map>
#include <optional>
#include <tuple>

#include "stream/frame_difference.hpp"

namespace trunnion::stream {

class ShadowComparison {
 public:
  /// Frames that have no counterpart yet are kept for this many cycles.
  static constexpr std::uint64_t window_cycles = 8192;

  void original(const idl::stream::AxisFrame& frame) { take(frame, originals_, shadows_, true); }
  void shadow(const idl::stream::AxisFrame& frame) { take(frame, shadows_, originals_, false); }

  /// Cycles of all channels that both have written with the same values.
  std::uint64_t equal_cycles() const { return equal_cycles_; }
  /// The first difference found; the original's value comes first.
  const std::optional<FrameDifference>& first_difference() const { return difference_; }

 private:
  using Key = std::tuple<std::uint16_t, std::uint32_t, std::uint64_t>;  // channel, epoch, first cycle
  using Frames = std::map<Key, idl::stream::AxisFrame>;
  void take(const idl::stream::AxisFrame& frame, Frames& own, Frames& others, bool is_original);

  Frames originals_, shadows_;
  std::uint64_t equal_cycles_ = 0;
  std::optional<FrameDifference> difference_;
};

}  // namespace trunnion::stream
