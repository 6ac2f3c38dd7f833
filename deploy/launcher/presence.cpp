// SPDX-License-Identifier: Apache-2.0
#include "presence.hpp"

#include <utility>

namespace trunnion::launcher {

Presence::Presence(bus::Bus& bus, cluster::Identity own)
    : own_(std::move(own)),
      writer_(bus.writer(topics::launcher_identity)),
      reader_(bus.reader(topics::launcher_identity)) {}

void Presence::update(double now) {
  if (now - published_ >= period) {
    writer_.write(own_);
    published_ = now;
  }
  cluster::Identity identity;
  while (reader_.take(identity))
    if (cluster::conflict(own_, identity)) others_[identity.identity] = {identity, now};
  std::erase_if(others_, [&](const auto& entry) { return now - entry.second.at > silence; });
}

std::optional<cluster::Identity> Presence::other() const {
  if (others_.empty()) return std::nullopt;
  return others_.begin()->second.identity;
}

}  // namespace trunnion::launcher
