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

void CompensationCore::configure(const machine::Parameters& p, std::uint16_t channel) {
  const auto numbers = machine::channel_axes(p, channel).number;
  std::vector<Axis> axes(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    auto& axis = axes[i];
    const std::uint32_t a = numbers[i];
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
  }
  axes_ = std::move(axes);
}

bool CompensationCore::process(const idl::stream::AxisFrame& in, const stream::FeedbackWindow&,
                               idl::stream::AxisFrame& out) {
  out.axes = in.axes;
  out.setpoints.resize(in.setpoints.size());
  const std::size_t width = std::min(in.axes.size(), axes_.size());
  if (width == 0) return true;
  for (std::size_t row = 0; row < in.count && (row + 1) * in.axes.size() <= in.setpoints.size(); ++row) {
    for (std::size_t i = 0; i < width; ++i) {
      auto& axis = axes_[i];
      const double x = in.setpoints[row * in.axes.size() + i];
      if (!primed_) axis.last = x;
      if (x > axis.last) axis.direction = 1;
      if (x < axis.last) axis.direction = -1;
      axis.last = x;
      // A positive backlash is travel lost when the motion turns negative, so it is taken off there, step by
      // step.
      const double wanted = axis.direction < 0 ? -axis.backlash : 0;
      axis.added += std::clamp(wanted - axis.added, -axis.rate, axis.rate);
      out.setpoints[row * in.axes.size() + i] = x + axis.added + axis.pitch.at(x, axis.direction >= 0);
    }
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
