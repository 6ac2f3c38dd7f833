// SPDX-License-Identifier: Apache-2.0
// Launchers in one DDS domain know of each other.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bus/bus.hpp"
#include "cluster/launcher_identity.hpp"
#include "contracts/topics.hpp"

namespace trunnion::launcher {

/// Publishes this launcher's identity and hears those of others, whatever they were built with. In a secured
/// cluster it hears those of the same authority only.
class Presence {
 public:
  static constexpr double period = 1;   ///< s between two publications
  static constexpr double silence = 3;  ///< s after which a launcher is gone
  /// s for which a launcher listens before it starts anything: participants of two hosts find each other in
  /// half a second, also when a packet is lost.
  static constexpr double listening = 1.2;

  Presence(bus::Bus& bus, cluster::Identity own);
  /// Call it often; `now` in seconds.
  void update(double now);
  /// One that may not be in the domain beside this one.
  std::optional<cluster::Identity> other() const;
  const cluster::Identity& own() const { return own_; }

 private:
  struct Heard {
    cluster::Identity identity;
    double at = 0;
  };
  cluster::Identity own_;
  bus::Writer<cluster::Identity> writer_;
  bus::Reader<cluster::Identity> reader_;
  std::map<std::uint64_t, Heard> others_;
  double published_ = -period;
};

}  // namespace trunnion::launcher
