// SPDX-License-Identifier: Apache-2.0
// The removal of a tap that was left in its hole (G84.9; G39+ of the NUM dialect).
#pragma once

#include <cstddef>
#include <cstdint>

#include "language/block_context.hpp"

namespace trunnion::language {

class TapRemoval : private BlockHandler {
 public:
  explicit TapRemoval(BlockContext& context) : BlockHandler(context) {}

  /// One word of a linear axis: how far out from the position. K: the lead, negative of a left-hand thread.
  /// The spindle turns out of the thread at S.
  Fault run(std::uint16_t at);

 private:
  Fault check_spindle(std::uint16_t at) const;
  Fault check_direction(std::uint16_t at, std::size_t axis, const AxisValues& target) const;
};

}  // namespace trunnion::language
