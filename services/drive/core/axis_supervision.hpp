// SPDX-License-Identifier: Apache-2.0
// What is wrong with an axis under control: following errors, encoders that differ, travel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "axis_limits.hpp"
#include "drive_event.hpp"
#include "drive_hardware.hpp"

namespace trunnion::drive {

/// Periods after a motion in virtual time, until the servos are at rest.
inline constexpr std::uint32_t settling_periods = 250;

/// An axis in one period.
struct SupervisedAxis {
  const machine::AxisInfo& info;
  const AxisLimits& limits;
  const AxisStatus& status;
  double command = 0, velocity = 0;  ///< of the path; the velocity of a cycle
};

/// Of an axis that does not follow, once its drive is off.
DriveEvent excessive_following_error(const SupervisedAxis& axis);

/// An axis is named by its column.
class AxisSupervision {
 public:
  /// Not cyclic.
  void configure(std::size_t axes);

  /// One period. An error behind which a stop along the path moves the axis only further: it is far beyond
  /// its limit, or is there still when the axis should have come to rest. `row` is the newest one and `moves`
  /// the axis; the row `in_force` counts, not the newest of a queue.
  bool does_not_follow(std::size_t column, const SupervisedAxis& axis, bool moves, std::uint64_t row,
                       std::uint64_t in_force);
  /// What stops the axes, once until acknowledge().
  std::optional<DriveEvent> finding(std::size_t column, const SupervisedAxis& axis);
  void acknowledge() { std::fill(reported_.begin(), reported_.end(), false); }

  /// No field, a row of a simulation is in force in its own period: moved_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("reported", self.reported_);
    const auto& unsettled = self.unsettled_;
    if (!std::is_const_v<Self> ||
        std::any_of(unsettled.begin(), unsettled.end(), [](auto periods) { return periods > 0; }))
      visit("unsettled", self.unsettled_);
  }

 private:
  std::vector<bool> reported_;  // since the last acknowledge()
  // Of each axis: number of the newest row that moves it, and periods at rest with too large an error.
  std::vector<std::uint64_t> moved_;
  std::vector<std::uint32_t> unsettled_;
};

}  // namespace trunnion::drive
