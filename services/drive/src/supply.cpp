// SPDX-License-Identifier: Apache-2.0
// How far the setpoints at hand reach, and how many of them a stop takes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "drive_core.hpp"

namespace trunnion::drive {
namespace {
constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();
}

const double* DriveCore::row(const Channel& channel, std::uint64_t cycle) const {
  for (const auto* frame = channel.window.peek(); frame != nullptr;
       frame = channel.window.find(frame->first + frame->count))
    if (cycle >= frame->first && cycle < frame->first + frame->count)
      return &frame->setpoints[(cycle - frame->first) * frame->axes.size()];
  return nullptr;
}

DriveCore::Supply DriveCore::supply() const {
  std::uint64_t until = forever, last = next_;
  bool ends = true;
  for (const auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    std::uint64_t end = std::max(channel.window.next(), next_);
    bool ended = false;
    for (const auto* frame = channel.window.peek(); frame != nullptr && !ended && end < next_ + 4 * lead_;
         frame = channel.window.find(frame->first + frame->count)) {
      end = frame->first + frame->count;
      ended = frame->ends;
    }
    last = std::max(last, end);
    if (!ended) {
      ends = false;
      until = std::min(until, end);
    }
  }
  return {(ends ? last : until) - next_, ends};
}

// Setpoints of every axis at `cycle`; axes no channel moves then keep the point of the path they are at.
void DriveCore::target_of(std::uint64_t cycle, std::vector<double>& out) {
  out = target_;
  for (auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    const double* values = row(channel, cycle);
    if (values == nullptr) continue;
    const auto* frame = channel.window.peek();
    if (channel.axes != frame->axes) {
      channel.axes = frame->axes;
      channel.columns.clear();
      for (const auto axis : channel.axes) channel.columns.push_back(machine::column_of(axes_, axis));
    }
    for (std::size_t i = 0; i < channel.columns.size(); ++i)
      if (channel.columns[i] >= 0) {
        const auto column = static_cast<std::size_t>(channel.columns[i]);
        out[column] = slaves_.setpoint(column, values[i]);
      }
  }
}

// Periods it takes to stop from the fastest speed of the next `cycles` cycles with every axis within its
// acceleration.
double DriveCore::stop_periods(std::uint64_t cycles) {
  double periods = 0;
  before_ = target_;
  for (std::uint64_t c = next_; c < next_ + cycles; ++c) {
    target_of(c, scratch_);
    for (std::size_t i = 0; i < axes_.size(); ++i)
      periods = std::max(periods, std::abs(scratch_[i] - before_[i]) / (limits_[i].acceleration * dt_ * dt_));
    std::swap(before_, scratch_);
  }
  return periods;
}

bool DriveCore::enough(const Supply& s) const { return s.cycles > 0 && (s.ends || s.cycles > reserve_); }

bool DriveCore::prefilled(const Supply& s) const { return s.ends || s.cycles >= prefill_; }

bool DriveCore::waiting() const { return mode_ == Mode::FOLLOWING && any_active() && !enough(supply()); }

bool DriveCore::can_step(bool give_up) const {
  switch (mode_) {
    case Mode::BRAKING:
    case Mode::RETURNING:
    case Mode::HOMING:
      return true;
    case Mode::HELD:
      return resume_demanded() && prefilled(supply());
    case Mode::OFF:
      return hardware_->running_out();
    case Mode::FOLLOWING:
      break;
  }
  if (!any_active()) return settle_ > 0 || needs_time();
  const auto s = supply();
  return enough(s) || (give_up && reserve_ > 0);
}

}  // namespace trunnion::drive
