// SPDX-License-Identifier: Apache-2.0
#include "core/run_time.hpp"

namespace trunnion::gateway {
namespace {

bool runs_program(const idl::channel::ChannelState& channel) {
  return channel.suspended ||
         (channel.mode == idl::channel::Mode::AUTO && channel.state != idl::channel::RunState::IDLE);
}

}  // namespace

void RunTime::observe(const idl::channel::ChannelState& channel, std::uint64_t tick) {
  const bool active = runs_program(channel);
  if (active && (!active_ || tick < start_)) {
    start_ = tick;
    partial_ = !seen_ || active_;
  }
  if ((active || active_) && tick >= start_) ticks_ = tick - start_;
  active_ = active;
  seen_ = true;
}

}  // namespace trunnion::gateway
