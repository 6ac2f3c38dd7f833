// SPDX-License-Identifier: Apache-2.0
#include "skip_move.hpp"

namespace trunnion::channel {

void SkipMove::begin(std::uint32_t input) {
  input_ = input;
  from_.reset();
  touch_.reset();
}

void SkipMove::moves_from(std::uint64_t cycle) {
  if (!from_) from_ = cycle;
}

void SkipMove::on_feedback(const idl::stream::Feedback& feedback, const machine::ChannelAxes& axes,
                           const std::vector<int>& columns) {
  if (!input_ || !from_ || touch_) return;
  for (const auto& edge : feedback.skips) {
    if (edge.input != *input_ || edge.cycle <= *from_) continue;
    if (edge.cycle < feedback.first || edge.cycle - feedback.first >= feedback.count) continue;
    const double* commanded = &feedback.commanded[(edge.cycle - feedback.first) * feedback.axis_count];
    touch_ = Touch{edge.cycle, {}};
    for (std::size_t i = 0; i < axes.index.size(); ++i) {
      if (columns[i] < 0 || static_cast<std::size_t>(columns[i]) >= edge.position.size()) continue;
      const auto column = static_cast<std::size_t>(columns[i]);
      touch_->deviation[axes.index[i]] = edge.position[column] - commanded[column];
    }
    return;
  }
}

}  // namespace trunnion::channel
