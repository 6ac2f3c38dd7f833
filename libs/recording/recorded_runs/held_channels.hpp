// SPDX-License-Identifier: Apache-2.0
// Finds the stops of channels while a run is recorded.
#pragma once

#include <vector>

#include "contracts/types.hpp"

namespace trunnion::recorded_runs {

/// Which channels have come to a stop since they were looked at last.
class HeldChannels {
 public:
  explicit HeldChannels(std::size_t channels) : held_(channels) {}
  /// `newest`: by channel. Each stop is named once.
  std::vector<std::size_t> newly(const std::vector<idl::channel::ChannelState>& newest);

 private:
  std::vector<bool> held_;
};

}  // namespace trunnion::recorded_runs
