// SPDX-License-Identifier: Apache-2.0
// Rigid tapping along a line in any direction (G174, G184 of Haas mills).
#pragma once

#include "language/block_context.hpp"

namespace trunnion::language {

class LineTapping : private BlockHandler {
 public:
  explicit LineTapping(BlockContext& context) : BlockHandler(context) {}

  /// From the position to X Y Z at S, and back. A spindle that turns is stopped before and turns again
  /// behind.
  Fault run(std::uint16_t at, bool left_hand);

 private:
  Fault check(std::uint16_t at, std::uint32_t axes) const;
  Fault stroke_to(const AxisValues& target, double lead);
};

}  // namespace trunnion::language
