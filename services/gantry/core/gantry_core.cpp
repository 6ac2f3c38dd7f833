// SPDX-License-Identifier: Apache-2.0
#include "gantry_core.hpp"

#include <algorithm>
#include <array>

#include "stream/gantry_synchronization.hpp"

namespace trunnion::gantry {

void GantryCore::configure(const machine::Parameters& p, std::uint16_t channel) {
  const auto numbers = machine::channel_axes(p, channel).number;
  pairs_ = machine::gantry_pairs(p, channel);
  master_index_.clear();
  for (const auto& pair : pairs_)
    master_index_.push_back(
        static_cast<std::size_t>(std::find(numbers.begin(), numbers.end(), pair.master) - numbers.begin()));
  offsets_.assign(pairs_.size(), 0.0);
  own_columns_ = false;
}

bool GantryCore::process(const idl::stream::AxisBatch& in, const stream::FeedbackWindow&,
                         idl::stream::AxisBatch& out) {
  const std::size_t width = in.axes.size();
  out.axes = in.axes;
  std::array<std::size_t, 32> columns{};
  const bool has_masters =
      std::all_of(master_index_.begin(), master_index_.end(), [&](std::size_t i) { return i < width; });
  // No slaves, or no batch of a configured channel.
  if (pairs_.empty() || !has_masters || width + pairs_.size() > columns.size()) {
    out.setpoints = in.setpoints;
    return true;
  }
  own_columns_ = false;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto own = std::find(in.axes.begin(), in.axes.end(), pairs_[k].slave);
    if (own != in.axes.end()) {
      columns[k] = static_cast<std::size_t>(own - in.axes.begin());
      own_columns_ = true;
    } else {
      columns[k] = out.axes.size();
      out.axes.push_back(pairs_[k].slave);
    }
  }
  const std::size_t out_width = out.axes.size();
  out.setpoints.resize(in.count * out_width);
  for (std::size_t row = 0; row < in.count; ++row) {
    const double* from = &in.setpoints[row * width];
    double* to = &out.setpoints[row * out_width];
    std::copy_n(from, width, to);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double followed = pairs_[k].slave_position(from[master_index_[k]]);
      if (columns[k] >= width) to[columns[k]] = followed;
      offsets_[k] = to[columns[k]] - followed;
    }
  }
  return true;
}

void GantryCore::load(std::span<const double> state) {
  offsets_ = stream::compensated_offsets(pairs_.size(), state);
  own_columns_ = !pairs_.empty() && state.size() == pairs_.size();
}

void GantryCore::save(stream::StateValues& state) const {
  state.clear();
  if (own_columns_) state.assign(offsets_.begin(), offsets_.end());
}

}  // namespace trunnion::gantry
