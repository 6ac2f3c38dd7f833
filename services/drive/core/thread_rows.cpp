// SPDX-License-Identifier: Apache-2.0
// The setpoints of a channel while its axes follow the angle of a spindle (thread).
#include <algorithm>
#include <array>
#include <cmath>

#include "channel_streams.hpp"

namespace trunnion::drive {

const double* ChannelStream::thread_angle(std::uint64_t cycle) const {
  for (const auto* batch = window.peek(); batch != nullptr;
       batch = window.find(batch->first + batch->count)) {
    if (cycle < batch->first || cycle >= batch->first + batch->count) continue;
    return batch->follows_spindle && !batch->spindle.empty() ? &batch->spindle[cycle - batch->first]
                                                             : nullptr;
  }
  return nullptr;
}

void ChannelStream::take_columns(const std::vector<machine::AxisInfo>& drive_axes) {
  const auto* batch = window.peek();
  if (batch == nullptr || axes == batch->axes) return;
  axes = batch->axes;
  columns.clear();
  for (const auto axis : axes) columns.push_back(machine::column_of(drive_axes, axis));
  thread.clear();
}

bool ChannelStream::in_thread() const {
  const auto* batch = window.peek();
  return thread.active() || (batch != nullptr && batch->follows_spindle);
}

// Those at hand that are nearest to `cycle`, of the motion that is executed.
const double* ChannelStream::nearest_row(std::uint64_t cycle) const {
  const double* row = nullptr;
  for (const auto* batch = window.peek(); batch != nullptr && batch->axes == axes;
       batch = window.find(batch->first + batch->count)) {
    const auto last = batch->first + batch->count - 1;
    row = &batch->setpoints[(std::clamp(cycle, batch->first, last) - batch->first) * axes.size()];
    if (cycle <= last || batch->ends) break;
  }
  return row;
}

const double* ChannelStream::kept_row(std::uint64_t cycle) const {
  const double* kept = thread.kept(cycle);
  return kept != nullptr ? kept : nearest_row(cycle);
}

void ChannelStream::thread_row(std::uint64_t cycle, std::span<double> out) const {
  const double *low = nullptr, *high = nullptr;
  double shift = 0, part = 0;
  for (std::size_t i = 0; i < std::min(columns.size(), out.size()); ++i) {
    if (low == nullptr || thread.shift(i) != shift) {
      shift = thread.shift(i);
      const double whole = std::floor(shift);
      const auto at = static_cast<std::int64_t>(cycle) + static_cast<std::int64_t>(whole);
      part = shift - whole;
      low = kept_row(static_cast<std::uint64_t>(std::max<std::int64_t>(at, 0)));
      high = part > 0 ? kept_row(static_cast<std::uint64_t>(std::max<std::int64_t>(at + 1, 0))) : low;
    }
    out[i] = low[i] + part * (high[i] - low[i]);
  }
}

// Cycles behind the one that is passed until the stream ends, as far as they are at hand.
std::uint64_t ChannelStream::left(const PassedPeriod& period) const {
  for (const auto* batch = window.peek(); batch != nullptr && batch->first < period.next + period.lead;
       batch = window.find(batch->first + batch->count))
    if (batch->ends) return batch->first + batch->count - 1 - period.next;
  return period.lead;
}

ThreadLimits ChannelStream::thread_limits(const PassedPeriod& period,
                                          const std::vector<AxisLimits>& limits) const {
  ThreadLimits permitted;
  const double dt = period.dt;
  const double* before = nullptr;
  const auto first = period.next - std::min<std::uint64_t>(period.next, ThreadFollowing::back);
  for (auto cycle = first; cycle <= period.next + ThreadFollowing::ahead(period.lead); ++cycle) {
    const double* row = kept_row(cycle);
    if (row == nullptr) continue;
    for (std::size_t i = 0; before != nullptr && i < columns.size(); ++i) {
      if (columns[i] < 0 || row[i] == before[i]) continue;
      const auto& axis = limits[static_cast<std::size_t>(columns[i])];
      const double way = std::abs(row[i] - before[i]);
      permitted.rate = std::min(permitted.rate, std::max(0.0, axis.velocity * dt / way - 1));
      permitted.change = std::min(permitted.change, axis.acceleration * dt * dt / way);
    }
    before = row;
  }
  return permitted;
}

void ChannelStream::follow_spindle(const PassedPeriod& period, const std::vector<SpindleStatus>& status,
                                   const Spindles& spindles, const std::vector<AxisLimits>& limits) {
  const auto permitted = thread_limits(period, limits);
  if (!period.whole) return thread.hold(columns.size(), permitted);
  const bool follows = thread_angle(period.next) != nullptr;
  const int column = follows ? machine::column_of(spindles.axes(), window.peek()->spindle_axis) : -1;
  if (column < 0) return thread.fade(columns.size(), permitted);

  std::array<double, ThreadFollowing::most_ahead + 1> angles{};
  const auto ahead = static_cast<std::size_t>(ThreadFollowing::ahead(period.lead));
  std::size_t count = 0;
  while (count <= ahead) {
    const double* angle = thread_angle(period.next + count);
    if (angle == nullptr) break;
    angles[count++] = *angle;
  }
  std::array<double, ThreadFollowing::most_columns> lags{};
  const auto axis_count = std::min(columns.size(), lags.size());
  for (std::size_t i = 0; i < axis_count; ++i)
    if (columns[i] >= 0) lags[i] = limits[static_cast<std::size_t>(columns[i])].lag / period.dt;

  const auto& measured = status[static_cast<std::size_t>(column)];
  thread.follow({measured.angle, measured.speed / 60 * period.dt, period.periods},
                {{angles.data(), count}, ahead, left(period)}, {lags.data(), axis_count}, permitted);
}

}  // namespace trunnion::drive
