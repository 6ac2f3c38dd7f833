// SPDX-License-Identifier: Apache-2.0
// A channel that cannot use the parameters it starts with: it says why and takes nothing but a reset, which
// makes corrected ones active.
#pragma once

#include "core/channel_core.hpp"
#include "service/alarm_board.hpp"

namespace trunnion::channel {

class UnusableParameters {
 public:
  /// Whenever the parameters may have changed: the alarm of the core's fault is there for as long as the
  /// fault is.
  void show(const ChannelCore& core, std::uint32_t channel, service::AlarmBoard& alarms);
  /// In place of ChannelCore::handle().
  static Answer handle(ChannelCore& core, const idl::channel::ChannelRequest& request);

 private:
  std::optional<ChannelEvent> shown_;
};

}  // namespace trunnion::channel
