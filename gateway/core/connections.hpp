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
  waiting,       ///< for a request, or for the rest of it
  streaming,     ///< states go to it as they change: a WebSocket, a client of MTConnect
  transferring,  ///< a program comes, an answer goes, or something is looked up for one
  answering      ///< its order is with the cluster
};

struct Connection {
  std::string peer;  ///< address
  Activity activity = Activity::waiting;
  bool arriving = false;  ///< it waits, and bytes have come that were not read yet: perhaps an order
};

/// HTTP connections at a time, and how many of them may be at work: the others are the reserve in which a new
/// connection can always say what it wants.
inline constexpr std::size_t most_connections = 160, most_at_work = 128;

/// Index of the connection to be closed for a new one; `connections` from the oldest to the newest. It is one
/// that waits for a request of which nothing arrives, or else a stream. When more than `at_work` do something
/// else: one that transfers, or else one whose order is with the cluster, which acts on it although nobody
/// hears so. Of these, the oldest of the peer with most connections. Nothing when there are none, or when one
/// must be read first because its request arrives: closed, its order would be lost.
std::optional<std::size_t> one_to_close(std::span<const Connection> connections,
                                        std::size_t at_work = most_at_work);

}  // namespace trunnion::gateway
