// SPDX-License-Identifier: Apache-2.0
#include "recorded_runs/held_channels.hpp"

namespace trunnion::recorded_runs {

std::vector<std::size_t> HeldChannels::newly(const std::vector<idl::channel::ChannelState>& newest) {
  std::vector<std::size_t> channels;
  for (std::size_t c = 0; c < newest.size(); ++c) {
    const bool held = newest[c].state == idl::channel::RunState::HELD;
    if (held && !held_[c]) channels.push_back(c);
    held_[c] = held;
  }
  return channels;
}

}  // namespace trunnion::recorded_runs
