// SPDX-License-Identifier: Apache-2.0
// Axis lock: the program runs and the displayed positions move, the locked axes stay at rest.
#pragma once

#include <cstdint>

#include "language/canonical.hpp"

namespace trunnion::channel {

using language::AxisValues;

class AxisLock {
 public:
  /// Locks the axes of `mask` (bit a for language::Axis a) at `position`, in machine coordinates.
  void set(std::uint16_t mask, const AxisValues& position) {
    mask_ = mask;
    held_ = position;
  }
  bool any() const { return mask_ != 0; }
  bool locked(std::size_t axis) const { return ((mask_ >> axis) & 1u) != 0; }
  std::uint16_t mask() const { return mask_; }

  /// The setpoints: `values` with the locked axes at their position.
  AxisValues hold(AxisValues values) const { return replace(values, held_); }
  /// For the display: the machine's `real` position with that of the program for the locked axes.
  AxisValues show(AxisValues real, const AxisValues& program) const { return replace(real, program); }
  /// The locked axes are at `real` now.
  void adopt(const AxisValues& real) { held_ = real; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("mask", self.mask_), visit("held", self.held_);
  }

 private:
  AxisValues replace(AxisValues values, const AxisValues& by) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (locked(i)) values[i] = by[i];
    return values;
  }
  std::uint16_t mask_ = 0;
  AxisValues held_{};
};

}  // namespace trunnion::channel
