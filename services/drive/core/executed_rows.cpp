// SPDX-License-Identifier: Apache-2.0
#include "executed_rows.hpp"

#include <utility>

namespace trunnion::drive {

void ExecutedRows::handed_over(std::uint64_t cycle, std::uint64_t number,
                               const std::vector<double>& setpoints) {
  pending_.push_back({cycle, number});
  pending_setpoints_.insert(pending_setpoints_.end(), setpoints.begin(), setpoints.end());
}

void ExecutedRows::skip_edge(std::uint64_t number, const idl::stream::SkipEdge& edge) {
  if (waiting_edges_.size() == most_skip_edges) return;
  waiting_edges_.push_back(edge);
  waiting_edges_.back().cycle = number;
}

void ExecutedRows::report_skip_edges(const Pending& executed) {
  std::size_t kept = 0;
  for (auto& edge : waiting_edges_) {
    if (edge.cycle > executed.number) {
      if (&edge != &waiting_edges_[kept]) waiting_edges_[kept] = std::move(edge);
      ++kept;
    } else if (skips_.size() < most_skip_edges) {
      edge.cycle = executed.cycle;
      skips_.push_back(std::move(edge));
    }
  }
  waiting_edges_.resize(kept);
}

void ExecutedRows::encoder_row(const EncoderRow& row) {
  in_force_ = row.number;
  const auto axes = static_cast<std::ptrdiff_t>(row.axes.size());
  std::ptrdiff_t done = 0;
  while (done < std::ssize(pending_) && pending_[static_cast<std::size_t>(done)].number <= row.number) {
    if (count_ == 0) first_ = pending_[static_cast<std::size_t>(done)].cycle;
    ++count_;
    report_skip_edges(pending_[static_cast<std::size_t>(done)]);
    const auto setpoints = pending_setpoints_.begin() + done * axes;
    commanded_.insert(commanded_.end(), setpoints, setpoints + axes);
    actual_.insert(actual_.end(), row.axes.begin(), row.axes.end());
    spindle_angle_.insert(spindle_angle_.end(), row.spindles.begin(), row.spindles.end());
    ++done;
  }
  if (done == 0) return;
  pending_.erase(pending_.begin(), pending_.begin() + done);
  pending_setpoints_.erase(pending_setpoints_.begin(), pending_setpoints_.begin() + done * axes);
}

void ExecutedRows::fill(idl::stream::Feedback& out, std::uint64_t next) {
  out.first = count_ > 0 ? first_ : next - pending();
  out.count = std::exchange(count_, 0);
  std::swap(out.commanded, commanded_);
  std::swap(out.actual, actual_);
  std::swap(out.spindle_angle, spindle_angle_);
  std::swap(out.skips, skips_);
  commanded_.clear();
  actual_.clear();
  spindle_angle_.clear();
  skips_.clear();
}

}  // namespace trunnion::drive
