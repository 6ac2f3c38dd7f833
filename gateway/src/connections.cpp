// SPDX-License-Identifier: Apache-2.0
#include "src/connections.hpp"

#include <map>

namespace trunnion::gateway {

std::optional<std::size_t> one_to_close(std::span<const Connection> connections) {
  std::map<std::string, std::size_t> held;
  for (const auto& connection : connections) ++held[connection.peer];
  for (const auto activity : {Activity::waiting, Activity::transferring}) {
    std::optional<std::size_t> chosen;
    for (std::size_t i = 0; i < connections.size(); ++i) {
      if (connections[i].activity != activity) continue;
      if (!chosen || held[connections[i].peer] > held[connections[*chosen].peer]) chosen = i;
    }
    if (chosen) return chosen;
  }
  return std::nullopt;
}

}  // namespace trunnion::gateway
