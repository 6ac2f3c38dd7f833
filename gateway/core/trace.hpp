// SPDX-License-Identifier: Apache-2.0
// Actual positions between two messages, thinned so that their number stays small however fast virtual time
// runs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace trunnion::gateway {

class Trace {
 public:
  static constexpr std::size_t most_rows = 64;

  /// Keeps every n-th row that is not the same as the one before; n doubles whenever the rows become too
  /// many.
  void add(std::uint64_t cycle, std::span<const double> row) {
    if (seen_++ % stride_ != 0) return;
    if (!rows_.empty() && std::equal(row.begin(), row.end(), rows_.back().begin(), rows_.back().end()))
      return;
    if (rows_.size() == most_rows) {
      for (std::size_t i = 1; i < most_rows / 2; ++i) {
        rows_[i] = std::move(rows_[2 * i]);
        cycles_[i] = cycles_[2 * i];
      }
      rows_.resize(most_rows / 2);
      cycles_.resize(most_rows / 2);
      stride_ *= 2;
    }
    rows_.emplace_back(row.begin(), row.end());
    cycles_.push_back(cycle);
  }
  bool empty() const { return rows_.empty(); }
  std::uint64_t first() const { return cycles_.empty() ? 0 : cycles_.front(); }
  /// Cycle of each row, ascending.
  const std::vector<std::uint64_t>& cycles() const { return cycles_; }
  const std::vector<std::vector<double>>& rows() const { return rows_; }
  void clear() {
    rows_.clear();
    cycles_.clear();
    stride_ = 1;
    seen_ = 0;
  }

 private:
  std::vector<std::vector<double>> rows_;
  std::vector<std::uint64_t> cycles_;
  std::uint64_t stride_ = 1, seen_ = 0;
};

}  // namespace trunnion::gateway
