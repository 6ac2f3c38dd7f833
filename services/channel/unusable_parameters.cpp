// SPDX-License-Identifier: Apache-2.0
#include "unusable_parameters.hpp"

namespace trunnion::channel {

void UnusableParameters::show(const ChannelCore& core, std::uint32_t channel, service::AlarmBoard& alarms) {
  const auto& fault = core.unusable();
  if (shown_ && (!fault || fault->alarm != shown_->alarm)) alarms.clear(*shown_->alarm, channel);
  if (fault && (!shown_ || fault->text != shown_->text)) alarms.raise(*fault->alarm, channel, fault->text);
  shown_ = fault;
}

Answer UnusableParameters::handle(ChannelCore& core, const idl::channel::ChannelRequest& request) {
  if (request.command == idl::channel::CommandKind::RESET) return core.handle(request);
  const auto& fault = *core.unusable();
  return {false, fault.alarm->number, fault.text};
}

}  // namespace trunnion::channel
