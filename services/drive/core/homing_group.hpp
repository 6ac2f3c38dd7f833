// SPDX-License-Identifier: Apache-2.0
// The homing of an axis and of the slaves that move with it: nothing is racked, and each finds its own
// reference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "axis_limits.hpp"
#include "gantry_slaves.hpp"
#include "homing_cycle.hpp"
#include "machine/axes.hpp"

namespace trunnion::drive {

/// Axes are named by their columns.
class HomingGroup {
 public:
  struct Member {
    std::size_t column = 0;
    double sign = 1, from = 0;  // of its motion in that of the axis; position at the start
    bool edge_taken = false, mark_taken = false;
    double latch = 0;
    std::uint64_t marks = 0;  // when its edge was taken

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("column", self.column), visit("sign", self.sign), visit("from", self.from);
      visit("edge_taken", self.edge_taken), visit("mark_taken", self.mark_taken);
      visit("latch", self.latch), visit("marks", self.marks);
    }
  };
  enum class Start {
    moves,
    nothing,   ///< no axis has to search
    contrary,  ///< they would search in opposite directions
  };

  /// `channel` demands the reference of the axis in `column`, which is at rest. The distance of a slave that
  /// moves with it is not known any longer. Cyclic only behind a first call: that one allocates.
  void gather(std::uint16_t channel, std::size_t column, GantrySlaves& slaves,
              const std::vector<double>& command);
  /// `limits` of all axes. `speed` mm/s or deg/s makes the search slower; 0 does not.
  Start start(const machine::AxisInfo& axis, const std::vector<AxisLimits>& limits,
              const std::vector<double>& command, double speed = 0);
  /// Brakes and ends as failed.
  void abort() { homing_.abort(); }
  /// One period of `period` s: the setpoints of its axes in `command`. Cyclic.
  HomingCycle::State step(const std::vector<AxisLimits>& limits, const std::vector<AxisStatus>& status,
                          double period, std::vector<double>& command);
  /// Whose reference is found or needs no search; until end().
  const std::vector<Member>& members() const { return members_; }
  /// By what the positions of a member become greater; none when it has its reference.
  static std::optional<double> shift(const Member& member, const AxisLimits& limits, const AxisStatus& status,
                                     double command);
  /// Why it has failed, for the operator; empty when whoever has ended it knows.
  std::string failure(const machine::AxisInfo& axis, const AxisLimits& limits) const;
  void end() { members_.clear(); }

  /// The axis moves off its home switch, before the search.
  bool leaves_switch() const { return homing_.leaves_switch(); }
  std::size_t column() const { return column_; }
  std::uint16_t channel() const { return channel_; }

  /// Members and channel are written where there are some.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    constexpr bool reads = !std::is_const_v<Self>;
    visit("homing", self.homing_), visit("homing_axis", self.column_);
    if (reads || !self.members_.empty()) visit("homing_members", self.members_);
    if (reads || self.channel_ != 0) visit("homing_channel", self.channel_);
  }

 private:
  HomingCycle::Signals signals(const std::vector<AxisLimits>& limits, const std::vector<AxisStatus>& status);

  HomingCycle homing_;
  std::size_t column_ = 0;
  std::uint16_t channel_ = 0;    // that has demanded it
  std::vector<Member> members_;  // the axis and the slaves that move with it
};

}  // namespace trunnion::drive
