// SPDX-License-Identifier: Apache-2.0
// Compensation of the jump at a reversal (quadrant jump; parameters 30a110 .. 30a114, numbers inferred).
#pragma once

#include "compensation/error_table.hpp"

namespace trunnion::compensation {

/// After a reversal an axis sticks, which leaves a jump on a circle where the quadrant changes. An addition
/// in the new direction pushes it through: after a delay it rises to the amount and falls to zero again, in
/// curves whose velocity and acceleration are zero at both ends.
struct ReversalJump {
  double amount = 0;                     ///< mm or deg; 0 off
  double delay = 0, rise = 1, fall = 1;  ///< cycles
  double age = -1;                       ///< state: cycles since the reversal, below zero: none

  static ReversalJump read(const machine::Parameters& parameters, std::uint32_t axis);

  /// The addition for one cycle; `direction` is that of the last move.
  double add(bool reversed, double direction);
};

}  // namespace trunnion::compensation
