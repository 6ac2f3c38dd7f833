// SPDX-License-Identifier: Apache-2.0
// How long the program of a channel has run.
#pragma once

#include <cstdint>

#include "contracts/types.hpp"

namespace trunnion::gateway {

/// In periods of the drive since the start, holds and what is done by hand in between included. The time of a
/// run that has ended stays until the next start.
class RunTime {
 public:
  void observe(const idl::channel::ChannelState& channel, std::uint64_t tick);
  std::uint64_t ticks() const { return ticks_; }
  /// The program ran before it was observed: the time is longer.
  bool partial() const { return partial_; }

 private:
  std::uint64_t start_ = 0, ticks_ = 0;
  bool active_ = false, seen_ = false, partial_ = false;
};

}  // namespace trunnion::gateway
