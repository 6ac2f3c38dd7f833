// SPDX-License-Identifier: Apache-2.0
// Feedback rows by cycle: what a stage computes for cycle n may use the row of cycle n - lead - 1, never "the
// latest".
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "contracts/types.hpp"

namespace trunnion::stream {

class FeedbackWindow {
 public:
  static constexpr std::size_t rows = 2048;

  void put(const idl::stream::Feedback& feedback) {
    if (feedback.axis_count == 0) return;
    if (begin_ == none || is_first(feedback)) begin_ = feedback.first;
    if (feedback.axis_count != axes_) {
      axes_ = feedback.axis_count;
      actual_.assign(rows * axes_, 0.0);
      cycle_.assign(rows, none);
    }
    for (std::uint32_t i = 0; i < feedback.count; ++i) {
      const std::uint64_t cycle = feedback.first + i;
      if ((i + 1) * axes_ > feedback.actual.size()) break;
      cycle_[cycle % rows] = cycle;
      std::memcpy(&actual_[cycle % rows * axes_], &feedback.actual[i * axes_], axes_ * sizeof(double));
    }
  }
  /// Encoder positions of every axis at `cycle`, or null when that row is not here.
  const double* actual(std::uint64_t cycle) const {
    if (axes_ == 0 || is_before_history(cycle) || cycle_[cycle % rows] != cycle) return nullptr;
    return &actual_[cycle % rows * axes_];
  }
  /// The row does not count: it was executed before the oldest feedback of this drive. One that was started
  /// on kept state has none of the cycles before, and whoever still has them must not use them: a process
  /// that starts later would compute something else.
  bool is_before_history(std::uint64_t cycle) const { return begin_ != none && cycle < begin_; }
  std::size_t axes() const { return axes_; }

 private:
  // What a drive that has just started reports: its parameters and nothing else have been applied.
  static bool is_first(const idl::stream::Feedback& feedback) {
    return feedback.count == 0 && feedback.applied.size() == 1 &&
           feedback.applied[0].input == idl::stream::Input::PARAMETER_SET;
  }

  static constexpr std::uint64_t none = ~0ull;
  std::uint64_t begin_ = none;  // the first row that came, or would have come next
  std::size_t axes_ = 0;
  std::vector<std::uint64_t> cycle_;
  std::vector<double> actual_;
};

}  // namespace trunnion::stream
