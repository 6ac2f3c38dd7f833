// SPDX-License-Identifier: Apache-2.0
// Canned cycles as LinuxCNC means them: G73, G74, G81 to G86, G89.
#pragma once

#include "language/block_context.hpp"
#include "language/drilling_cycles.hpp"

namespace trunnion::language {

/// Words keep their value as long as the same cycle is active; in G91 R counts from the level before the
/// cycle and the depth from R. Below R the tool rises to R before it goes to the hole.
class LinuxcncCycles : private BlockHandler {
 public:
  LinuxcncCycles(BlockContext& context, DrillingCycles& holes) : BlockHandler(context), holes_(holes) {}

  /// A block while a cycle is modal.
  Fault run();

 private:
  /// A hole needs axis words, a feed, and for tapping a spindle that turns.
  Fault check(std::uint16_t at) const;
  Fault check_tapping(std::uint16_t at) const;
  Fault read_levels(std::uint16_t at, bool same, LinuxcncCycleWords& words);
  Fault read_settings(std::uint16_t at, bool same, LinuxcncCycleWords& words);
  Fault drill(const LinuxcncCycleWords& words, std::uint32_t repeats);

  DrillingCycles& holes_;
};

}  // namespace trunnion::language
