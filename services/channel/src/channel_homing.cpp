// SPDX-License-Identifier: Apache-2.0
// The drive moves an axis that searches its reference; the channel lets it, and ends the search for whatever
// stops any other motion of the channel.
#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::channel {

bool ChannelCore::needs_homing(std::uint16_t axis) const {
  return unreferenced_.contains(axis) ||
         (parameters_ && parameters_->integer(parameter::homing_direction, axis) != 0);
}

Answer ChannelCore::begin_homing(std::uint16_t axis) {
  if (states_.busy()) return refuse(alarm::request_invalid, "The channel is busy");
  if (auto answer = operable(); !answer.accepted) return answer;
  homing_ = Homing{axis};
  advance_homing();
  return {};
}

// The drive knows no override: the axis brakes, and searches from where it is when there is one again.
void ChannelCore::advance_homing() {
  if (!homing_) return;
  auto& link = stream_.link();
  const bool moves = switches_.feed_override > 0;
  if (link.homing()) {
    if (!homing_->searches || moves) return;
    link.leave();
    homing_->searches = false;
  } else if (homing_->searches || homing_->ended || link.drive_mode() == DriveMode::OFF) {
    homing_.reset();
  } else if (moves) {
    link.request_homing(homing_->axis);
    homing_->searches = true;
  }
}

void ChannelCore::end_homing() {
  if (!homing_) return;
  if (homing_->searches && link().homing()) stream_.link().leave();
  homing_->searches = false, homing_->ended = true;
  advance_homing();
}

RunState ChannelCore::run_state() const {
  if (!homing_) return states_.published();
  return homing_->ended ? RunState::HOLDING : RunState::RUNNING;
}

std::string ChannelCore::homing_detail() const {
  const auto& axes = machine_.channel_axes();
  std::string name;
  for (std::size_t i = 0; i < axes.number.size(); ++i)
    if (axes.number[i] == homing_->axis) name = language::axis_letters[axes.index[i]];
  if (homing_->ended) return "axis " + name + " brakes, its homing has ended";
  return "axis " + name + " searches its reference" +
         (switches_.feed_override > 0 ? "" : ": the feed override is 0 %");
}

}  // namespace trunnion::channel
