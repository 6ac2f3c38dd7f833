// SPDX-License-Identifier: Apache-2.0
// Compares the output of a stage on standby with that of the stage, in any order of arrival.
#pragma once

#include <map>
#include <optional>
#include <tuple>

#include "stream/batch_difference.hpp"

namespace trunnion::stream {

class BatchComparison {
 public:
  /// Batches that have no counterpart yet are kept for this many cycles.
  static constexpr std::uint64_t window_cycles = 8192;

  void original(const idl::stream::AxisBatch& batch) { take(batch, originals_, standby_, true); }
  void standby(const idl::stream::AxisBatch& batch) { take(batch, standby_, originals_, false); }

  /// Cycles of all channels that both have written with the same values.
  std::uint64_t equal_cycles() const { return equal_cycles_; }
  /// The first difference found; the original's value comes first.
  const std::optional<BatchDifference>& first_difference() const { return difference_; }

 private:
  using Key = std::tuple<std::uint16_t, std::uint32_t, std::uint64_t>;  // channel, epoch, first cycle
  using Batches = std::map<Key, idl::stream::AxisBatch>;
  void take(const idl::stream::AxisBatch& batch, Batches& own, Batches& others, bool is_original);

  Batches originals_, standby_;
  std::uint64_t equal_cycles_ = 0;
  std::optional<BatchDifference> difference_;
};

}  // namespace trunnion::stream
