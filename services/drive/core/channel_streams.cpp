// SPDX-License-Identifier: Apache-2.0
#include "channel_streams.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace trunnion::drive {
namespace {
constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();
// Of a channel that the drive has forgotten. After the last of all epochs there would be none.
constexpr std::uint32_t most_epochs = 1u << 24;
}  // namespace

const double* ChannelStream::row(std::uint64_t cycle) const {
  for (const auto* batch = window.peek(); batch != nullptr; batch = window.find(batch->first + batch->count))
    if (cycle >= batch->first && cycle < batch->first + batch->count)
      return &batch->setpoints[(cycle - batch->first) * batch->axes.size()];
  return nullptr;
}

const double* ChannelStream::spindle_row(std::uint64_t cycle) const {
  for (const auto* batch = window.peek(); batch != nullptr;
       batch = window.find(batch->first + batch->count)) {
    if (cycle < batch->first || cycle >= batch->first + batch->count) continue;
    if (batch->spindle.empty() || batch->follows_spindle) return nullptr;
    return &batch->spindle[cycle - batch->first];
  }
  return nullptr;
}

// A start within an epoch whose start this process did not see is a message from before it was restarted.
bool ChannelStream::expects(const idl::stream::StreamRequest& wanted) const {
  return wanted.kind == idl::stream::StreamRequestKind::NEW_EPOCH
             ? wanted.epoch > epoch && wanted.epoch - epoch <= most_epochs
             : begun && wanted.epoch == epoch;
}

void ChannelStream::refuse_waiting() {
  if (waiting.request == 0) return;
  request = waiting.request;
  search = idl::stream::ReferenceSearch::SEARCH_FAILED;
  waiting = {};
}

void ChannelStream::release_spindle(Spindles& spindles) {
  if (spindle >= 0) spindles.coupling(spindle).release();
  spindle = -1;
}

ChannelStream* ChannelStreams::next_waiting(std::uint16_t channel) {
  ChannelStream* first = nullptr;
  for (auto& [number, other] : channels_) {
    if (other.waiting.request == 0) continue;
    if (number > channel) return &other;
    if (first == nullptr) first = &other;
  }
  return first;
}

void ChannelStreams::refuse_waiting() {
  for (auto& [number, channel] : channels_) channel.refuse_waiting();
}

ChannelStream* ChannelStreams::find(std::uint16_t channel) {
  const auto found = channels_.find(channel);
  return found == channels_.end() ? nullptr : &found->second;
}

const ChannelStream* ChannelStreams::find(std::uint16_t channel) const {
  const auto found = channels_.find(channel);
  return found == channels_.end() ? nullptr : &found->second;
}

bool ChannelStreams::put(idl::stream::AxisBatch& batch) {
  auto* channel = find(batch.channel);
  return channel == nullptr || channel->window.put(batch) != stream::Arrival::differs;
}

std::size_t ChannelStreams::active() const {
  return static_cast<std::size_t>(
      std::count_if(channels_.begin(), channels_.end(), [](const auto& c) { return c.second.active; }));
}

bool ChannelStreams::any_active() const {
  return std::any_of(channels_.begin(), channels_.end(), [](const auto& c) { return c.second.active; });
}

bool ChannelStreams::any_starts(std::uint64_t next) const {
  return std::any_of(channels_.begin(), channels_.end(),
                     [&](const auto& c) { return c.second.active && c.second.start == next; });
}

bool ChannelStreams::any_skips() const {
  return std::any_of(channels_.begin(), channels_.end(), [](const auto& c) { return c.second.skip_move; });
}

bool ChannelStreams::resume_demanded() const {
  return any_active() && std::all_of(channels_.begin(), channels_.end(),
                                     [](const auto& c) { return c.second.resume || !c.second.active; });
}

void ChannelStreams::forget_resumes() {
  for (auto& [number, channel] : channels_) channel.resume = false;
}

bool ChannelStreams::let_begin(std::uint64_t next, bool prefilled) {
  bool begun = false;
  for (auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    if (!channel.prefilled && channel.start <= next) channel.prefilled = prefilled;
    begun = begun || channel.prefilled;
  }
  return begun;
}

StreamSupply ChannelStreams::supply(std::uint64_t next, std::uint64_t lead) const {
  std::uint64_t until = forever, last = next;
  bool ends = true;
  for (const auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    std::uint64_t end = std::max(channel.window.next(), next);
    bool ended = false;
    for (const auto* batch = channel.window.peek(); batch != nullptr && !ended && end < next + 4 * lead;
         batch = channel.window.find(batch->first + batch->count)) {
      end = batch->first + batch->count;
      ended = batch->ends;
    }
    last = std::max(last, end);
    if (!ended) {
      ends = false;
      if (channel.in_thread()) end = std::max(next, end - std::min(end, ThreadFollowing::ahead(lead)));
      until = std::min(until, end);
    }
  }
  return {(ends ? last : until) - next, ends};
}

std::uint64_t ChannelStreams::ahead(std::uint64_t lead) const {
  const bool thread = std::any_of(channels_.begin(), channels_.end(),
                                  [](const auto& c) { return c.second.active && c.second.in_thread(); });
  return thread ? ThreadFollowing::ahead(lead) : 0;
}

void ChannelStreams::setpoints(std::uint64_t cycle, const std::vector<machine::AxisInfo>& axes,
                               const GantrySlaves& slaves, std::vector<double>& out) {
  for (auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    const double* values = channel.row(cycle);
    if (values == nullptr) continue;
    channel.take_columns(axes);
    std::array<double, ThreadFollowing::most_columns> shifted{};
    if (channel.thread.active()) {
      channel.thread_row(cycle, shifted);
      values = shifted.data();
    }
    for (std::size_t i = 0; i < channel.columns.size(); ++i)
      if (channel.columns[i] >= 0) {
        const auto column = static_cast<std::size_t>(channel.columns[i]);
        out[column] = slaves.setpoint(column, values[i]);
      }
  }
}

void ChannelStreams::couple_spindles(std::uint64_t next, const std::vector<SpindleStatus>& status,
                                     Spindles& spindles) {
  for (auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    const double* revolutions = channel.spindle_row(next);
    if (revolutions == nullptr) {
      channel.release_spindle(spindles);
      continue;
    }
    if (channel.spindle < 0)
      channel.spindle = machine::column_of(spindles.axes(), channel.window.peek()->spindle_axis);
    if (channel.spindle < 0) continue;
    const double angle = status[static_cast<std::size_t>(channel.spindle)].angle;
    spindles.coupling(channel.spindle).couple(*revolutions, angle);
  }
}

void ChannelStreams::lead_spindles(std::uint64_t next, double phase, Spindles& spindles) const {
  for (const auto& [number, channel] : channels_) {
    if (!channel.active || channel.spindle < 0) continue;
    if (const double* revolutions = channel.spindle_row(next))
      spindles.coupling(channel.spindle).lead(phase, *revolutions);
  }
}

void ChannelStreams::follow_spindles(const PassedPeriod& period, const std::vector<SpindleStatus>& status,
                                     const Spindles& spindles, const std::vector<machine::AxisInfo>& axes,
                                     const std::vector<AxisLimits>& limits) {
  for (auto& [number, channel] : channels_) {
    if (!channel.active || !channel.in_thread() || channel.row(period.next) == nullptr) continue;
    channel.take_columns(axes);
    channel.follow_spindle(period, status, spindles, limits);
  }
}

void ChannelStreams::pass(std::uint64_t next, Spindles& spindles) {
  for (auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    const auto* batch = channel.window.peek();
    if (batch == nullptr) continue;
    channel.skip_move = batch->skip_move;
    if (next >= batch->first && next < batch->first + batch->count) {
      auto& speeds = spindles.surface_speeds();
      if (batch->turning_radius.empty())
        speeds.pass(number);
      else
        speeds.turn_at(number, batch->turning_radius[next - batch->first]);
    }
    if (const double* values = channel.row(next); values != nullptr && channel.thread.active())
      channel.thread.keep(next, {values, batch->axes.size()}, channel.thread_angle(next));
    if (next + 1 != batch->first + batch->count) continue;
    channel.snapshot = batch->snapshot;
    channel.states = batch->states;
    const bool ends = batch->ends;
    channel.window.advance();
    if (!ends) continue;
    channel.active = false;
    channel.ending = true;
    channel.release_spindle(spindles);
    channel.thread.clear();
  }
}

void ChannelStreams::executed() {
  for (auto& [number, channel] : channels_) channel.ending = false;
}

void ChannelStreams::restore(const Memory& memory) {
  for (auto& [number, channel] : channels_) {
    const auto& kept = memory.channels[number % memory.channels.size()];
    channel.begun = kept.begun != 0;
    channel.epoch = channel.begun ? kept.epoch : memory.epoch;
    channel.request = kept.request;
  }
}

void ChannelStreams::keep(Memory& memory) const {
  for (const auto& [number, channel] : channels_) {
    memory.epoch = std::max(memory.epoch, channel.epoch);
    memory.channels[number % memory.channels.size()] = {channel.epoch, channel.request, channel.begun};
  }
}

void ChannelStreams::fill(std::uint64_t next, idl::stream::Feedback& out) const {
  out.channels.resize(channels_.size());
  std::size_t k = 0;
  for (const auto& [number, channel] : channels_) {
    auto& echo = out.channels[k++];
    echo.channel = number;
    echo.epoch = channel.epoch;
    echo.active = channel.active || channel.ending;
    echo.next = next;
    echo.request = channel.request;
    echo.start = channel.start;
    echo.snapshot = channel.snapshot;
    echo.states = channel.states;
    echo.search = channel.search;
  }
}

}  // namespace trunnion::drive
