// SPDX-License-Identifier: Apache-2.0
// Moves that are more than a path: those a skip input ends, and those a spindle follows.
#include "channel_core.hpp"

namespace trunnion::channel {

// The axes are at rest, and nothing is read ahead before the move has ended.
void ChannelCore::begin_skip() {
  const auto input = flow().pending().number;
  if (flow().push_pending() != FlowState::alarm) skip_.begin(input);
}

void ChannelCore::finish_skip() {
  const auto& path = this->path();
  SkipResult result;
  result.stopped = result.touched = path.position();
  if (const auto& touch = skip_.touch()) {
    // The path at the cycle of the edge, and the axes' deviation from it when the input came on.
    AxisValues machine = path.machine_of(stream_.at(touch->cycle).position);
    for (std::size_t i = 0; i < machine.size(); ++i) machine[i] += touch->deviation[i];
    result.touched = path.path_of(machine);
  }
  skip_.end();
  flow().skip_ended(result);
}

void ChannelCore::begin_tapping() {
  const auto& spindle = machine_.tapping_spindle(flow().pending().number);
  if (!spindle.axis) {
    flow().refuse_pending(language::AlarmNumber::tapping_spindle_missing);
    return;
  }
  tapping_.begin(path().position(), flow().pending());
  path().trajectory().set_limits(tapping_.limits(manual_.path_limits(), spindle.acceleration));
  path().restart();
  flow().set_tapping(true);
}

void ChannelCore::finish_tapping() {
  if (!tapping_.active()) return;
  tapping_.end();
  flow().set_tapping(false);
  path().trajectory().set_limits(manual_.path_limits());
  path().restart();
}

}  // namespace trunnion::channel
