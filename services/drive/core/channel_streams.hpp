// SPDX-License-Identifier: Apache-2.0
// The streams that feed the drive, one of each channel: which of them take part, and how far the setpoints at
// hand reach. Spindles follow them: their setpoints come with those of the axes and are passed, interpolated
// and braked along with them, so a spindle keeps its place to the axes whatever the drive does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <type_traits>
#include <vector>

#include "axis_limits.hpp"
#include "contracts/types.hpp"
#include "drive_memory.hpp"
#include "gantry_slaves.hpp"
#include "machine/axes.hpp"
#include "spindles.hpp"
#include "stream/batch_window.hpp"
#include "thread_following.hpp"

namespace trunnion::drive {

/// A period in which the setpoints of the cycle `next` are passed.
struct PassedPeriod {
  std::uint64_t next = 0, lead = 32;
  double dt = 0.001;   ///< s
  double periods = 1;  ///< from the newest angles of the spindles to the end of the period of these setpoints
  bool whole = true;   ///< one cycle passes in each period: the drive neither brakes nor resumes
};

struct ChannelStream {
  stream::BatchWindow<idl::stream::AxisBatch> window;
  bool active = false;
  bool ending = false;     ///< its last setpoints are handed over and not all executed
  bool prefilled = false;  ///< enough has arrived to begin
  bool begun = false;      ///< an epoch was started in this process
  bool resume = false;     ///< continues, once every channel that was stopped does
  std::uint32_t epoch = 0, request = 0;
  std::uint64_t start = 0;
  idl::stream::ChannelSnapshot snapshot;
  std::vector<idl::stream::StageState> states;
  std::vector<std::uint16_t> axes;  ///< of the batches, and the column of each
  std::vector<int> columns;
  int spindle = -1;        ///< that follows the channel's batches
  bool skip_move = false;  ///< of the newest batch of which a setpoint was passed
  idl::stream::ReferenceSearch search = idl::stream::ReferenceSearch::NO_SEARCH;  ///< of its newest HOME
  idl::stream::StreamRequest waiting{};  ///< a HOME behind the search of another; its number is 0: none
  ThreadFollowing thread;

  /// Setpoints of the axes of the batch at `cycle`; null when they are not here.
  const double* row(std::uint64_t cycle) const;
  /// Revolutions of the spindle at `cycle`; null when none follows.
  const double* spindle_row(std::uint64_t cycle) const;
  /// The angle of the spindle that the setpoints of `cycle` follow (thread); null when they follow none.
  const double* thread_angle(std::uint64_t cycle) const;
  /// Of the batch that comes next.
  void take_columns(const std::vector<machine::AxisInfo>& drive_axes);
  bool in_thread() const;
  /// Before the cycle of `period` is passed, in a thread.
  void follow_spindle(const PassedPeriod& period, const std::vector<SpindleStatus>& status,
                      const Spindles& spindles, const std::vector<AxisLimits>& limits);
  /// Setpoints as row(), each at the place of its axis: `cycle` is not passed.
  void thread_row(std::uint64_t cycle, std::span<double> out) const;
  /// The epoch of a START or NEW_EPOCH is the one that comes next.
  bool expects(const idl::stream::StreamRequest& request) const;
  /// A HOME that waits is answered: it has failed.
  void refuse_waiting();
  void release_spindle(Spindles& spindles);

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("window", self.window), visit("active", self.active), visit("ending", self.ending);
    visit("prefilled", self.prefilled), visit("begun", self.begun), visit("epoch", self.epoch);
    visit("request", self.request), visit("start", self.start), visit("snapshot", self.snapshot);
    visit("states", self.states), visit("axes", self.axes), visit("columns", self.columns);
    visit("spindle", self.spindle), visit("skip_move", self.skip_move);
    visit("resume", self.resume);
    if (!std::is_const_v<Self> || self.search != idl::stream::ReferenceSearch::NO_SEARCH)
      visit("search", self.search);
    if (!std::is_const_v<Self> || self.waiting.request != 0) visit("waiting", self.waiting);
    if (!std::is_const_v<Self> || self.thread.active()) visit("thread", self.thread);
  }

 private:
  const double* nearest_row(std::uint64_t cycle) const;
  const double* kept_row(std::uint64_t cycle) const;
  std::uint64_t left(const PassedPeriod& period) const;
  ThreadLimits thread_limits(const PassedPeriod& period, const std::vector<AxisLimits>& limits) const;
};

/// How far the setpoints at hand reach.
struct StreamSupply {
  std::uint64_t cycles = 0;  ///< from the next one on, for every channel that owes one
  bool ends = false;         ///< nothing is owed after them
};

/// `next` is the cycle that is handed over next.
class ChannelStreams {
 public:
  /// Not cyclic.
  void add(std::uint16_t channel) { channels_[channel]; }
  /// Null when the machine has no such channel.
  ChannelStream* find(std::uint16_t channel);
  const ChannelStream* find(std::uint16_t channel) const;

  /// A batch of the gantry stage; swapped away. False when a replica differs from what is here.
  bool put(idl::stream::AxisBatch& batch);

  std::size_t active() const;
  bool any_active() const;
  /// A channel begins with the cycle `next`.
  bool any_starts(std::uint64_t next) const;
  bool any_skips() const;
  /// Every channel that was stopped is to continue. The start of one channel moves no axis of another: who
  /// stands there has a key of his own.
  bool resume_demanded() const;
  void forget_resumes();
  /// A channel whose HOME waits, in the order of their numbers and around behind `channel`; null: none.
  ChannelStream* next_waiting(std::uint16_t channel);
  void refuse_waiting();
  /// Channels whose start has come begin when `prefilled`: there are enough setpoints. False when none has
  /// begun.
  bool let_begin(std::uint64_t next, bool prefilled);

  /// Looks a few `lead` ahead. Without what ahead() says.
  StreamSupply supply(std::uint64_t next, std::uint64_t lead) const;
  /// Cycles that must be at hand besides: axes of a thread may be as far before the cycle that is passed.
  std::uint64_t ahead(std::uint64_t lead) const;
  /// Setpoints at `cycle` in the columns of `axes`; those of axes that no channel moves then stay.
  void setpoints(std::uint64_t cycle, const std::vector<machine::AxisInfo>& axes, const GantrySlaves& slaves,
                 std::vector<double>& out);
  /// Before `next` is passed: spindles take its setpoint. Then they lead by a share `phase` of the one
  /// behind.
  void couple_spindles(std::uint64_t next, const std::vector<SpindleStatus>& status, Spindles& spindles);
  void lead_spindles(std::uint64_t next, double phase, Spindles& spindles) const;
  /// Before `next` is passed: threads go to the places that belong to the angles of their spindles.
  void follow_spindles(const PassedPeriod& period, const std::vector<SpindleStatus>& status,
                       const Spindles& spindles, const std::vector<machine::AxisInfo>& axes,
                       const std::vector<AxisLimits>& limits);
  /// The cycle `next` is handed over: batches that end with it are forgotten, and channels end with theirs.
  void pass(std::uint64_t next, Spindles& spindles);
  /// Every cycle that was handed over is executed.
  void executed();

  void restore(const Memory& memory);
  void keep(Memory& memory) const;
  void fill(std::uint64_t next, idl::stream::Feedback& out) const;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("channels", self.channels_);
  }

 private:
  std::map<std::uint16_t, ChannelStream> channels_;
};

}  // namespace trunnion::drive
