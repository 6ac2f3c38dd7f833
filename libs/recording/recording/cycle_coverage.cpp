// SPDX-License-Identifier: Apache-2.0
#include "recording/cycle_coverage.hpp"

#include <algorithm>
#include <iterator>

namespace trunnion::recording {

void CycleCoverage::add(std::uint64_t first, std::uint64_t count, bool starts, bool ends) {
  if (count == 0 || first + count < first) return;
  Run run{first + count, starts, ends};
  // Runs that overlap or touch become one.
  auto at = runs_.upper_bound(first);
  if (at != runs_.begin() && std::prev(at)->second.end >= first) at = std::prev(at);
  if (at != runs_.end() && at->first <= first && at->second.end >= run.end) {
    ++repeated_;
    return;
  }
  if (!runs_.empty() && runs_.rbegin()->second.end > first) ++late_;
  while (at != runs_.end() && at->first <= run.end) {
    if (at->first < first) {
      first = at->first;
      run.starts = at->second.starts;
    }
    if (at->second.end >= run.end) {
      run.end = at->second.end;
      run.ends = at->second.ends;
    }
    at = runs_.erase(at);
  }
  runs_[first] = run;
}

std::uint64_t CycleCoverage::covered() const {
  std::uint64_t sum = 0;
  for (const auto& [first, run] : runs_) sum += run.end - first;
  return sum;
}

std::uint64_t CycleCoverage::lost() const {
  std::uint64_t sum = 0;
  for (const auto& gap : gaps(runs_.size())) sum += gap.count;
  return sum;
}

std::vector<CycleRange> CycleCoverage::gaps(std::size_t most) const {
  std::vector<CycleRange> result;
  for (auto at = runs_.begin(); at != runs_.end() && std::next(at) != runs_.end() && result.size() < most;
       ++at) {
    const auto& [next_first, next] = *std::next(at);
    if (!(at->second.ends && next.starts)) result.push_back({at->second.end, next_first - at->second.end});
  }
  return result;
}

}  // namespace trunnion::recording
