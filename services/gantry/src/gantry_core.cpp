// SPDX-License-Identifier: Apache-2.0
#include "gantry_core.hpp"

#include <algorithm>
#include <array>

#include "machine/parameter_constants.hpp"

namespace trunnion::gantry {

double synchronization_error(const machine::GantryPair& pair, const double* actual) {
  return actual[pair.slave_column] - pair.slave_position(actual[pair.master_column]);
}

std::vector<double> compensated_offsets(std::size_t pairs, std::span<const double> state) {
  std::vector<double> offsets(pairs, 0.0);
  if (state.size() == 2 * pairs)
    std::copy_n(state.begin() + static_cast<long>(pairs), pairs, offsets.begin());
  return offsets;
}

void GantryCore::configure(const machine::Parameters& p, std::uint16_t channel) {
  lead_ = static_cast<std::uint64_t>(p.integer(parameter::stream_lead));
  const auto numbers = machine::channel_axes(p, channel).number;
  pairs_ = machine::gantry_pairs(p, channel);
  master_index_.clear();
  for (const auto& pair : pairs_)
    master_index_.push_back(
        static_cast<std::size_t>(std::find(numbers.begin(), numbers.end(), pair.master) - numbers.begin()));
  corrections_.assign(pairs_.size(), 0.0);
  offsets_.assign(pairs_.size(), 0.0);
  own_columns_ = false;
}

bool GantryCore::process(const idl::stream::AxisFrame& in, const stream::FeedbackWindow& feedback,
                         idl::stream::AxisFrame& out) {
  const std::size_t width = in.axes.size();
  if (pairs_.empty()) {
    out.axes = in.axes;
    out.setpoints = in.setpoints;
    return true;
  }
  // The error of cycle n is corrected at n + lead + 1: credits guarantee that its feedback exists by then.
  // The first cycles after a start of the drive on kept state have none: the axes were at rest.
  const std::uint64_t last = in.first + in.count - 1;
  for (std::uint64_t n = in.first; n <= last; ++n)
    if (n > lead_ && feedback.actual(n - lead_ - 1) == nullptr && !feedback.is_before_history(n - lead_ - 1))
      return false;
  out.axes = in.axes;
  std::array<std::size_t, 32> columns{};
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
    const std::uint64_t n = in.first + row;
    const double* actual = n > lead_ ? feedback.actual(n - lead_ - 1) : nullptr;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const auto& pair = pairs_[k];
      const double followed = pair.slave_position(from[master_index_[k]]);
      const double base = columns[k] < width ? from[columns[k]] : followed;
      // The encoders are that far apart when both axes are where they should be. Compensation changes little
      // in the lead that the feedback is old.
      offsets_[k] = base - followed;
      if (actual != nullptr) {
        const double error = synchronization_error(pair, actual) - offsets_[k];
        corrections_[k] = std::clamp(corrections_[k] - pair.rate * error, -pair.maximum, pair.maximum);
      }
      to[columns[k]] = base + corrections_[k];
    }
  }
  return true;
}

void GantryCore::load(std::span<const double> state) {
  corrections_.assign(pairs_.size(), 0.0);
  for (std::size_t i = 0; i < std::min(state.size(), corrections_.size()); ++i) corrections_[i] = state[i];
  offsets_ = compensated_offsets(pairs_.size(), state);
  own_columns_ = !pairs_.empty() && state.size() == 2 * pairs_.size();
}

void GantryCore::save(stream::StateValues& state) const {
  state = corrections_;
  if (own_columns_) state.insert(state.end(), offsets_.begin(), offsets_.end());
}

}  // namespace trunnion::gantry
