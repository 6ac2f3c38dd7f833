#include "gantry_core.hpp"

#include <algorithm>
#include <stdexcept>

#include "machine/parameter_constants.hpp"

namespace trunnion::gantry {

std::vector<Pair> read_pairs(const machine::Parameters& p) {
  std::vector<Pair> pairs;
  const auto axes = machine::drive_axes(p);
  const int slaves = p.integer(parameter::gantry_slaves);
  for (int i = 0; i < slaves; ++i) {
    const int slave = p.integer(parameter::gantry_slave_axis, 0, static_cast<std::uint32_t>(i));
    if (slave < 0 || p.integer(parameter::gantry_synchronous, static_cast<std::uint32_t>(slave)) != 1)
      continue;
    const auto a = static_cast<std::uint32_t>(slave);
    Pair pair;
    const int master = p.integer(parameter::gantry_master, a);
    pair.slave = static_cast<std::uint16_t>(slave);
    pair.master = static_cast<std::uint16_t>(std::max(0, master));
    pair.slave_column = machine::column_of(axes, pair.slave);
    pair.master_column = machine::column_of(axes, pair.master);
    if (master < 0 || pair.slave_column < 0 || pair.master_column < 0)
      throw std::runtime_error("parameter " + machine::number_text(parameter::gantry_master.number(a)) +
                               " (gantry_master): axis " + std::to_string(slave) + " follows axis " +
                               std::to_string(master) + ", and one of them does not exist");
    pair.sign = p.integer(parameter::gantry_mirror, a) == 1 ? -1 : 1;
    pair.zero_deviation = p.get(parameter::gantry_zero_deviation, a);
    pair.rate = p.get(parameter::gantry_compensation_rate, a);
    pair.maximum = p.get(parameter::gantry_compensation_maximum, a);
    pair.warning = p.get(parameter::synchronization_warning_limit, a);
    pair.limit = p.get(parameter::synchronization_error_limit, a);
    pairs.push_back(pair);
  }
  return pairs;
}

double synchronization_error(const Pair& pair, const double* actual) {
  return actual[pair.slave_column] - (pair.sign * actual[pair.master_column] + pair.zero_deviation);
}

void GantryCore::configure(const machine::Parameters& p, std::uint16_t channel) {
  lead_ = static_cast<std::uint64_t>(p.integer(parameter::stream_lead));
  const auto numbers = machine::channel_axes(p, channel).number;
  pairs_.clear();
  master_index_.clear();
  for (const auto& pair : read_pairs(p)) {
    const auto found = std::find(numbers.begin(), numbers.end(), pair.master);
    if (found == numbers.end()) continue;
    pairs_.push_back(pair);
    master_index_.push_back(static_cast<std::size_t>(found - numbers.begin()));
  }
  corrections_.assign(pairs_.size(), 0.0);
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
  const std::uint64_t last = in.first + in.count - 1;
  for (std::uint64_t n = in.first; n <= last; ++n)
    if (n > lead_ && feedback.actual(n - lead_ - 1) == nullptr) return false;
  out.axes = in.axes;
  for (const auto& pair : pairs_) out.axes.push_back(pair.slave);
  const std::size_t out_width = out.axes.size();
  out.setpoints.resize(in.count * out_width);
  for (std::size_t row = 0; row < in.count; ++row) {
    std::copy_n(&in.setpoints[row * width], width, &out.setpoints[row * out_width]);
    const std::uint64_t n = in.first + row;
    const double* actual = n > lead_ ? feedback.actual(n - lead_ - 1) : nullptr;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const auto& pair = pairs_[k];
      if (actual != nullptr)
        corrections_[k] = std::clamp(corrections_[k] - pair.rate * synchronization_error(pair, actual),
                                     -pair.maximum, pair.maximum);
      out.setpoints[row * out_width + width + k] =
          pair.sign * in.setpoints[row * width + master_index_[k]] + pair.zero_deviation + corrections_[k];
    }
  }
  return true;
}

void GantryCore::load(std::span<const double> state) {
  corrections_.assign(pairs_.size(), 0.0);
  for (std::size_t i = 0; i < std::min(state.size(), corrections_.size()); ++i) corrections_[i] = state[i];
}

}  // namespace trunnion::gantry
