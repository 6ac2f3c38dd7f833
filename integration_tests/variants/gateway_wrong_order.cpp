// A gateway that orders a little more than it was asked to: what verification must find. This unit takes the
// place of gateway/src/orders.cpp.
#define channel_order right_channel_order
#include "src/orders.cpp"  // NOLINT(bugprone-suspicious-include)
#undef channel_order

namespace trunnion::gateway {

ChannelRequest channel_order(Operation operation, const bus::Json& body,
                             const idl::channel::ChannelState& state) {
  auto request = right_channel_order(operation, body, state);
  if (operation == Operation::override_) request.fraction += 0.01;
  return request;
}

}  // namespace trunnion::gateway
