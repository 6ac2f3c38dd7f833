// SPDX-License-Identifier: Apache-2.0
// Backlash compensation (HNC-8 parameters 30a000 .. 30a003).
#pragma once

#include "compensation/error_table.hpp"

namespace trunnion::compensation {

struct Backlash {
  double amount = 0;       ///< mm or deg; 0 off
  double rapid = 0;        ///< mm or deg, faster than `rapid_step`
  double rapid_step = 0;   ///< mm or deg in one cycle
  bool has_rapid = false;  ///< type 2
  double rate = 0;         ///< mm or deg in one cycle: largest change of `added`
  double added = 0;        ///< state

  static Backlash read(const machine::Parameters& parameters, std::uint32_t axis);
  bool active() const { return amount != 0 || (has_rapid && rapid != 0); }

  /// The addition for a cycle in which the axis moves by `step` (mm or deg) and `direction` is that of its
  /// last move: minus the backlash in negative direction, reached by `rate` in each cycle.
  double add(double direction, double step) {
    const double value = has_rapid && step > rapid_step ? rapid : amount;
    const double wanted = direction < 0 ? -value : 0;
    added += std::clamp(wanted - added, -rate, rate);
    return added;
  }
};

}  // namespace trunnion::compensation
