// SPDX-License-Identifier: Apache-2.0
// The channel's end of the stream: its place in it, its credits, and what the drive reports of it.
#pragma once

#include <optional>
#include <vector>

#include "contracts/types.hpp"

namespace trunnion::channel {

enum class LinkState {
  idle,       ///< owes nothing
  requested,  ///< has asked the drive for a place
  active,     ///< writes batches
  ending,     ///< has written its last batch; the drive has yet to execute it
  refused,    ///< the drive gave no place
  lost,       ///< the drive forgot the stream: it was restarted
};

using idl::stream::DriveMode;

class StreamLink {
 public:
  explicit StreamLink(std::uint16_t channel) : channel_(channel) {}

  void on_feedback(const idl::stream::Feedback& feedback);
  /// Asks for a place; with a new epoch when the drive's position is where the stream must begin.
  void request_start();
  /// Demands that the drive searches the home switch of an axis, by its logical number; the next start is a
  /// new epoch. `speed` mm/s or deg/s, 0 = the axis' own.
  void request_homing(std::uint16_t axis, double speed);
  /// It has been demanded, or ended by leave(), and the drive may still move the axis.
  bool homing() const { return homing_; }
  /// It has been demanded, and the drive searches an axis of another channel before.
  bool homing_waits() const { return homing_ && answered_ != request_ && mode_ == DriveMode::HOMING; }
  /// Of the newest that the drive has answered.
  idl::stream::ReferenceSearch search() const { return search_; }
  /// A hold of the drive is over.
  void request_resume();
  /// What was written and not executed is void, and a search for a reference ends; the next start is a new
  /// epoch.
  void leave();
  /// A batch of `count` setpoints may be written now.
  bool credit(std::uint32_t count, std::uint64_t ahead) const {
    return state_ == LinkState::active && next_ + count <= executed_ + ahead;
  }
  void written(std::uint32_t count, bool ends) {
    next_ += count;
    starts_ = false;
    if (ends) state_ = LinkState::ending;
  }
  /// After refused or lost.
  void acknowledge() {
    state_ = LinkState::idle;
    new_epoch_ = true;
  }

  /// A resume was requested, and the drive still holds: it has not answered, or waits for other channels.
  bool resuming() const { return resuming_; }
  LinkState state() const { return state_; }
  /// Nothing before the first feedback.
  std::optional<DriveMode> drive_mode() const { return mode_; }
  bool has_feedback() const { return mode_.has_value(); }
  std::uint64_t next() const { return next_; }
  std::uint64_t executed() const { return executed_; }
  /// Of the newest feedback: periods of the drive since its start.
  std::uint64_t tick() const { return tick_; }
  std::uint32_t epoch() const { return epoch_; }
  bool starts() const { return starts_; }
  bool needs_epoch() const { return new_epoch_; }
  /// Of the channel at the consistent cut; not valid while there is none.
  const idl::stream::ChannelSnapshot& snapshot() const { return snapshot_; }
  /// States of the stages behind the channel at the consistent cut.
  const std::vector<idl::stream::StageState>& states() const { return states_; }
  const std::vector<double>& positions() const { return positions_; }
  /// The axis in this column is a slave that is taken off its master.
  bool taken_off(std::size_t column) const {
    return column < enabled_.size() && (enabled_[column] & 2u) != 0;
  }
  /// The drive still executes (or holds) a stream of ours that this process did not write.
  bool echo_active() const { return echo_active_; }
  /// The newest feedback is the first of another process of the drive, which has answered nothing yet.
  bool drive_restarted() const { return drive_restarted_; }
  std::optional<idl::stream::StreamRequest> take_request();
  /// Everything has been taken, and the channel owes nothing: the state that fields() lists is whole.
  bool at_rest() const { return state_ == LinkState::idle && !outgoing_ && !homing_; }

  /// No field, the constructor sets it: channel_. No fields, at rest the link is idle: state_, outgoing_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("mode", self.mode_), visit("next", self.next_), visit("executed", self.executed_),
        visit("tick", self.tick_);
    visit("epoch", self.epoch_), visit("request", self.request_), visit("answered", self.answered_);
    visit("new_epoch", self.new_epoch_), visit("starts", self.starts_);
    visit("echo_active", self.echo_active_), visit("resuming", self.resuming_);
    visit("drive_restarted", self.drive_restarted_), visit("asked", self.asked_);
    visit("snapshot", self.snapshot_), visit("states", self.states_), visit("positions", self.positions_);
  }

 private:
  void request(idl::stream::StreamRequestKind kind);
  std::uint16_t channel_;
  LinkState state_ = LinkState::idle;
  std::optional<DriveMode> mode_;
  std::uint64_t next_ = 0, executed_ = 0, tick_ = 0;
  std::uint32_t epoch_ = 0, request_ = 0, answered_ = 0;
  bool new_epoch_ = true, starts_ = false, echo_active_ = false, resuming_ = false, drive_restarted_ = false,
       asked_ = false;                     // the drive, by this process
  bool homing_ = false;                    // no field: it is at rest in no snapshot
  idl::stream::ReferenceSearch search_{};  // no field: feedback tells it
  std::uint32_t drive_epoch_ = 0;          // no field: feedback tells it
  idl::stream::ChannelSnapshot snapshot_;
  std::vector<idl::stream::StageState> states_;
  std::vector<double> positions_;
  std::vector<std::uint8_t> enabled_;  // no field: feedback tells it
  std::optional<idl::stream::StreamRequest> outgoing_;
};

}  // namespace trunnion::channel
