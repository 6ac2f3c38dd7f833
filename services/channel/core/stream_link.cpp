// SPDX-License-Identifier: Apache-2.0
#include "stream_link.hpp"

#include <algorithm>
#include <utility>

namespace trunnion::channel {

using idl::stream::ReferenceSearch;
using idl::stream::StreamRequestKind;

void StreamLink::on_feedback(const idl::stream::Feedback& feedback) {
  mode_ = feedback.mode;
  tick_ = feedback.tick;
  const auto executed = feedback.first + feedback.count;
  // A drive that has lost what it published last counts cycles again that this epoch has used.
  const bool counts_again = executed < executed_;
  executed_ = executed;
  positions_ = feedback.position;
  enabled_ = feedback.enabled;
  // The first feedback of a drive that has just started applies its parameters, and no input that could have
  // switched it off.
  drive_restarted_ = counts_again || (feedback.applied.size() == 1 &&
                                      feedback.applied[0].input == idl::stream::Input::PARAMETER_SET);
  for (const auto& echo : feedback.channels) {
    if (echo.channel != channel_) continue;
    echo_active_ = echo.active;
    drive_epoch_ = echo.epoch;
    search_ = echo.search;
    const bool forgotten = echo.request < answered_;
    drive_restarted_ = drive_restarted_ || forgotten;
    answered_ = echo.request;
    if ((forgotten || counts_again) && state_ == LinkState::idle) new_epoch_ = true;
    if (counts_again && state_ == LinkState::requested) state_ = LinkState::lost;
    if (echo.snapshot.valid) snapshot_ = echo.snapshot;
    if (!echo.states.empty()) states_ = echo.states;
    if (!asked_) {  // a process before this one may have: numbers and epochs continue from its newest
      request_ = echo.request;
      epoch_ = echo.epoch;
    }
    const bool ours = echo.request == request_ && echo.epoch == epoch_;
    if (ours && mode_ != DriveMode::HELD) resuming_ = false;
    const bool searches = mode_ == DriveMode::HOMING && (search_ == ReferenceSearch::SEARCHES ||
                                                         search_ == ReferenceSearch::MOVES_OFF_SWITCH);
    homing_ = homing_ && (searches || (!forgotten && echo.request != request_));
    switch (state_) {
      case LinkState::requested:
        if (!ours) break;
        if (echo.active) {
          state_ = LinkState::active;
          next_ = echo.start;
          starts_ = true;
          new_epoch_ = false;
        } else {
          state_ = LinkState::refused;
        }
        break;
      case LinkState::active:
      case LinkState::ending:
        if (echo.active) break;
        state_ = state_ == LinkState::ending && executed_ >= next_ ? LinkState::idle : LinkState::lost;
        break;
      default:
        break;
    }
  }
}

void StreamLink::request(StreamRequestKind kind) {
  asked_ = true;
  outgoing_ = {channel_, ++request_, kind, epoch_, 0, 0};
}

void StreamLink::request_start() {
  if (new_epoch_) epoch_ = std::max(epoch_, drive_epoch_) + 1;
  state_ = LinkState::requested;
  request(new_epoch_ ? StreamRequestKind::NEW_EPOCH : StreamRequestKind::START);
}

void StreamLink::request_homing(std::uint16_t axis, double speed) {
  asked_ = new_epoch_ = homing_ = true;
  outgoing_ = {channel_, ++request_, StreamRequestKind::HOME, epoch_, axis, speed};
}

void StreamLink::request_resume() {
  request(StreamRequestKind::RESUME);
  resuming_ = true;
}

void StreamLink::leave() {
  request(StreamRequestKind::LEAVE);
  state_ = LinkState::idle;
  new_epoch_ = true;
}

std::optional<idl::stream::StreamRequest> StreamLink::take_request() {
  return std::exchange(outgoing_, std::nullopt);
}

}  // namespace trunnion::channel
