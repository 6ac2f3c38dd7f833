// SPDX-License-Identifier: Apache-2.0
// Which cycles of a stream are in a recording, and which are missing.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace trunnion::recording {

struct CycleRange {
  std::uint64_t first = 0, count = 0;
  bool operator==(const CycleRange&) const = default;
};

/// The cycles of one channel, epoch and stage, in whatever order and however often they come: replicas of a
/// stage write each batch twice.
class CycleCoverage {
 public:
  /// A batch of `count` cycles from `first` on. `starts` and `ends` as in the batches: between a batch that
  /// ends and one that starts nothing is missing.
  void add(std::uint64_t first, std::uint64_t count, bool starts, bool ends);

  /// Cycles that some batch covers.
  std::uint64_t covered() const;
  /// Cycles between the first and the last that no batch covers although the channel was not idle.
  std::uint64_t lost() const;
  /// The same as ranges, ascending, at most `most` of them.
  std::vector<CycleRange> gaps(std::size_t most) const;
  /// The first cycle and the one after the last; 0 and 0 when there is none.
  std::uint64_t begin() const { return runs_.empty() ? 0 : runs_.begin()->first; }
  std::uint64_t end() const { return runs_.empty() ? 0 : runs_.rbegin()->second.end; }
  /// The first batch states that nothing was before it.
  bool begins_at_a_start() const { return runs_.empty() || runs_.begin()->second.starts; }
  /// Batches that brought nothing new.
  std::uint64_t repeated() const { return repeated_; }
  /// Batches that came after a later one, and were still news.
  std::uint64_t late() const { return late_; }

 private:
  struct Run {
    std::uint64_t end = 0;  // first cycle after it
    bool starts = false, ends = false;
  };
  std::map<std::uint64_t, Run> runs_;  // by first cycle, none touching the next
  std::uint64_t repeated_ = 0, late_ = 0;
};

}  // namespace trunnion::recording
