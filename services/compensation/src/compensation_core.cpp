// SPDX-License-Identifier: Apache-2.0
#include "compensation_core.hpp"

#include <algorithm>
#include <cmath>

#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {

double PitchTable::at(double x, bool positive_direction) const {
  const auto& table = bidirectional && !positive_direction ? negative : positive;
  if (!enabled || table.empty()) return 0;
  double place = (x - start) / interval;
  const auto n = static_cast<double>(table.size());
  if (modulo) {
    place -= std::floor(place / n) * n;
    const auto i = std::min(static_cast<std::size_t>(place), table.size() - 1);
    const double next = table[(i + 1) % table.size()];
    return factor * (table[i] + (next - table[i]) * (place - static_cast<double>(i)));
  }
  if (place <= 0) return factor * table.front();
  if (place >= n - 1) return factor * table.back();
  const auto i = static_cast<std::size_t>(place);
  return factor * (table[i] + (table[i + 1] - table[i]) * (place - static_cast<double>(i)));
}

CompensationCore::Axis CompensationCore::read_axis(const machine::Parameters& p, std::uint32_t a) {
  Axis axis;
  axis.backlash = p.integer(parameter::backlash_type, a) == 1 ? p.get(parameter::backlash, a) : 0;
  axis.rate = p.get(parameter::backlash_rate, a);
  auto& pitch = axis.pitch;
  const int type = p.integer(parameter::pitch_type, a);
  const int points = p.integer(parameter::pitch_points, a);
  pitch.enabled = type != 0 && points > 0;
  pitch.bidirectional = type == 2;
  pitch.modulo = p.integer(parameter::pitch_modulo, a) == 1;
  pitch.start = p.get(parameter::pitch_start, a);
  pitch.interval = p.get(parameter::pitch_interval, a);
  pitch.factor = p.get(parameter::pitch_override, a);
  const auto first = static_cast<std::uint32_t>(p.integer(parameter::pitch_table, a));
  for (int k = 0; k < points && pitch.enabled; ++k) {
    pitch.positive.push_back(p.at(first + static_cast<std::uint32_t>(k)));
    if (pitch.bidirectional) pitch.negative.push_back(p.at(first + static_cast<std::uint32_t>(points + k)));
  }
  return axis;
}

void CompensationCore::configure(const machine::Parameters& p, std::uint16_t channel) {
  const auto numbers = machine::channel_axes(p, channel).number;
  std::vector<Axis> axes;
  std::vector<Slave> slaves;
  for (const auto number : numbers) axes.push_back(read_axis(p, number));
  for (const auto& pair : machine::gantry_pairs(p, channel)) {
    const auto master =
        static_cast<std::size_t>(std::find(numbers.begin(), numbers.end(), pair.master) - numbers.begin());
    auto axis = read_axis(p, pair.slave);
    if (!axis.active() && !axes[master].active()) continue;
    axes.push_back(std::move(axis));
    slaves.push_back({pair, master});
  }
  axes_ = std::move(axes);
  slaves_ = std::move(slaves);
}

double CompensationCore::compensate(Axis& axis, double x) const {
  if (!primed_) axis.last = x;
  // The rounding of a transformation is no reversal: the backlash of an axis at rest must not jump by it.
  constexpr double rounding = 1e-9;  // mm or deg
  if (std::abs(x - axis.last) > rounding) {
    axis.direction = x > axis.last ? 1 : -1;
    axis.last = x;
  }
  // A positive backlash is travel lost when the motion turns negative, so it is taken off there, step by
  // step.
  const double wanted = axis.direction < 0 ? -axis.backlash : 0;
  axis.added += std::clamp(wanted - axis.added, -axis.rate, axis.rate);
  return x + axis.added + axis.pitch.at(x, axis.direction >= 0);
}

bool CompensationCore::process(const idl::stream::AxisFrame& in, const stream::FeedbackWindow&,
                               idl::stream::AxisFrame& out) {
  const std::size_t in_width = in.axes.size(), own = axes_.size() - slaves_.size();
  out.axes = in.axes;
  if (in_width != own) {  // no frame of a configured channel
    out.setpoints = in.setpoints;
    return true;
  }
  for (const auto& slave : slaves_) out.axes.push_back(slave.pair.slave);
  const std::size_t out_width = axes_.size();
  const std::size_t rows = own == 0 ? 0 : std::min<std::size_t>(in.count, in.setpoints.size() / own);
  out.setpoints.resize(rows * out_width);
  for (std::size_t row = 0; row < rows; ++row) {
    const double* from = &in.setpoints[row * in_width];
    double* to = &out.setpoints[row * out_width];
    for (std::size_t i = 0; i < own; ++i) to[i] = compensate(axes_[i], from[i]);
    for (std::size_t k = 0; k < slaves_.size(); ++k)
      to[own + k] = compensate(axes_[own + k], slaves_[k].pair.slave_position(from[slaves_[k].master]));
    primed_ = true;
  }
  return true;
}

void CompensationCore::load(std::span<const double> state) {
  primed_ = !state.empty() && state.size() == 3 * axes_.size();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    auto& axis = axes_[i];
    axis.last = primed_ ? state[3 * i] : 0;
    axis.direction = primed_ ? state[3 * i + 1] : 0;
    axis.added = primed_ ? state[3 * i + 2] : 0;
  }
}

void CompensationCore::save(stream::StateValues& state) const {
  state.resize(primed_ ? 3 * axes_.size() : 0);
  if (!primed_) return;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    state[3 * i] = axes_[i].last;
    state[3 * i + 1] = axes_[i].direction;
    state[3 * i + 2] = axes_[i].added;
  }
}

}  // namespace trunnion::compensation
