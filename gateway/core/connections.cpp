// SPDX-License-Identifier: Apache-2.0
#include "core/connections.hpp"

#include <algorithm>
#include <map>

namespace trunnion::gateway {

std::optional<std::size_t> one_to_close(std::span<const Connection> connections, std::size_t at_work) {
  std::map<std::string, std::size_t> held;
  for (const auto& connection : connections) ++held[connection.peer];
  const auto oldest = [&](Activity activity) {
    std::optional<std::size_t> chosen;
    for (std::size_t i = 0; i < connections.size(); ++i) {
      if (connections[i].activity != activity || connections[i].arriving) continue;
      if (!chosen || held[connections[i].peer] > held[connections[*chosen].peer]) chosen = i;
    }
    return chosen;
  };
  const auto count = [&](Activity activity) {
    return static_cast<std::size_t>(std::ranges::count(connections, activity, &Connection::activity));
  };
  if (count(Activity::transferring) + count(Activity::answering) <= at_work) {
    if (const auto chosen = oldest(Activity::waiting)) return chosen;
    if (count(Activity::waiting) > 0) return std::nullopt;
    if (const auto chosen = oldest(Activity::streaming)) return chosen;
  }
  for (const auto activity :
       {Activity::transferring, Activity::answering, Activity::waiting, Activity::streaming})
    if (const auto chosen = oldest(activity)) return chosen;
  return std::nullopt;
}

}  // namespace trunnion::gateway
