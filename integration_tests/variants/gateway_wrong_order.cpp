// SPDX-License-Identifier: Apache-2.0
// A gateway that asks for a little more than it was asked to: what verification must find. This unit takes
// the place of gateway/core/requests.cpp.
#define channel_request right_channel_request
#include "core/requests.cpp"  // NOLINT(bugprone-suspicious-include)
#undef channel_request

namespace trunnion::gateway {

idl::channel::ChannelRequest channel_request(std::string_view route, const bus::Json& body,
                                             const idl::channel::ChannelState& state) {
  auto request = right_channel_request(route, body, state);
  if (route == "override") request.fraction += 0.01;
  return request;
}

}  // namespace trunnion::gateway
