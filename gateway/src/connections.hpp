// SPDX-License-Identifier: Apache-2.0
// Which connection makes room for a new one, so that nobody who opens connections keeps an operator's stop
// out.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace trunnion::gateway {

/// What a connection does.
enum class Activity {
  waiting,       ///< for a request, or for the rest of its header
  transferring,  ///< a body comes or an answer goes
  answering      ///< its order is with the cluster
};

struct Connection {
  std::string peer;  ///< address
  Activity activity = Activity::waiting;
};

/// HTTP connections at a time.
inline constexpr std::size_t most_connections = 128;

/// Index of the connection to be closed for a new one; `connections` from the oldest to the newest. One that
/// waits for a request goes before one that transfers, and that of the peer with most connections before
/// others. Nothing when the cluster is working for every one of them.
std::optional<std::size_t> one_to_close(std::span<const Connection> connections);

}  // namespace trunnion::gateway
