// SPDX-License-Identifier: Apache-2.0
// What another gateway on this computer shows its clients.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace trunnion::gateway {

/// The first message of the WebSocket `target` of a server on this computer; nothing when there is none
/// within `timeout` seconds.
std::optional<std::string> first_message(std::uint16_t port, const std::string& target, double timeout);

}  // namespace trunnion::gateway
