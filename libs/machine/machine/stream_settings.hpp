// SPDX-License-Identifier: Apache-2.0
// How far the setpoints run ahead of the drive, and in which batches (parameters 000900 .. 000903).
#pragma once

#include <cstdint>

#include "machine/parameters.hpp"

namespace trunnion::machine {

/// All in cycles. In real time `ahead` is the lead. In virtual time no setpoint is ever late and nobody waits
/// for the machine, so the channel may write much farther ahead: fewer and longer batches cost less.
struct StreamSettings {
  StreamSettings() = default;
  StreamSettings(const Parameters& parameters, bool virtual_time);

  std::uint64_t lead = 32;   ///< 000900: what uses feedback for cycle n uses that of cycle n - lead - 1
  std::uint64_t ahead = 32;  ///< the channel writes at most this far beyond the executed cycle; >= lead
  std::uint32_t batch = 4;   ///< of a motion that uses no feedback
  std::uint32_t feedback_batch = 4;  ///< of a motion that does: two of them fit into the lead
};

}  // namespace trunnion::machine
