// SPDX-License-Identifier: Apache-2.0
// What an operator sets of a channel beside its state.
#pragma once

#include "language/block.hpp"

namespace trunnion::channel {

struct Switches {
  // Fractions within commands/override_limits.hpp.
  double feed_override = 1, rapid_override = 1, spindle_override = 1;
  bool single_block = false, optional_stop = false;
  // From the first block of a program on.
  bool dry_run = false;         ///< feeds of the program are replaced by parameter 04c914
  bool auxiliary_lock = false;  ///< M S T are passed over, except those of the program's flow
  language::SkipLevels block_skip = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("feed_override", self.feed_override), visit("rapid_override", self.rapid_override);
    visit("spindle_override", self.spindle_override), visit("single_block", self.single_block);
    visit("optional_stop", self.optional_stop), visit("dry_run", self.dry_run);
    visit("auxiliary_lock", self.auxiliary_lock), visit("block_skip", self.block_skip);
  }
};

}  // namespace trunnion::channel
