// SPDX-License-Identifier: Apache-2.0
// Where the slaves of gantries are beside their masters: the distance that stays, and slaves that are taken
// off.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "machine/gantry_pairs.hpp"

namespace trunnion::drive {

struct GantrySlave {
  machine::GantryPair pair;
  std::uint16_t channel = 0;          ///< of the master
  std::size_t place = 0, places = 0;  ///< among the pairs of that channel
  double offset = 0;  ///< mm, added to the setpoints of the slave: a misalignment that is not corrected
  bool offset_known = false;               ///< since the drives were switched on
  bool refused = false;                    ///< out of tolerance when they were switched on
  bool off_demanded = false, off = false;  ///< taken off its master
  double held = 0;                         ///< mm, where it stays while it is off

  std::size_t master_column() const { return static_cast<std::size_t>(pair.master_column); }
  std::size_t column() const { return static_cast<std::size_t>(pair.slave_column); }

  /// No fields, configure() sets them: pair, channel, place, places.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("offset", self.offset), visit("offset_known", self.offset_known);
    visit("refused", self.refused), visit("off_demanded", self.off_demanded);
    visit("off", self.off), visit("held", self.held);
  }
};

class ChannelStreams;

/// `command`: the setpoints of all axes in this period.
class GantrySlaves {
 public:
  /// Slaves keep their state when the parameters change. Without valid pairs there are none: the gantry stage
  /// reports the error.
  void configure(const machine::Parameters& parameters, std::size_t columns);
  bool empty() const { return slaves_.empty(); }
  std::vector<GantrySlave>& all() { return slaves_; }
  const std::vector<GantrySlave>& all() const { return slaves_; }
  /// Of the axis in `column`, or null when it is no slave.
  const GantrySlave* at(std::size_t column) const {
    return slaves_.empty() || by_column_[column] < 0 ? nullptr
                                                     : &slaves_[static_cast<std::size_t>(by_column_[column])];
  }
  /// mm by which a slave is ahead of its place beside its master, without what compensation accounts for,
  /// which is known once the channel has moved.
  static double misalignment(const GantrySlave& slave, const ChannelStreams& streams,
                             const std::vector<double>& command);
  /// `enable`: Outputs::axis_enable of the PLC.
  void demand_off(const std::vector<std::uint8_t>& enable);
  /// At rest: takes slaves off and couples them again as it is demanded.
  void couple(const std::vector<double>& command);
  /// Before `next`, the first setpoint of a channel since the drives were switched on or a slave was coupled:
  /// what is between the slave and its place stays.
  void keep_distances(const ChannelStreams& streams, std::uint64_t next, const std::vector<double>& command);
  /// The setpoint of an axis whose batch has `value`.
  double setpoint(std::size_t column, double value) const {
    const auto* slave = at(column);
    if (slave == nullptr) return value;
    return slave->off ? slave->held : value + slave->offset;
  }

  /// Written where there are some: recordings of machines without gantries have no such state.
  /// No field, configure() sets it: by_column_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    if (!std::is_const_v<Self> || !self.slaves_.empty()) visit("slaves", self.slaves_);
  }

 private:
  std::vector<GantrySlave> slaves_;
  std::vector<int> by_column_;
};

}  // namespace trunnion::drive
