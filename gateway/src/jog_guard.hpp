// SPDX-License-Identifier: Apache-2.0
// A continuous jog must be renewed: a browser that dies, or a network that breaks, stops the axis.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace trunnion::gateway {

/// Seconds that a continuous jog continues without being renewed.
inline constexpr double jog_timeout = 0.5;

class JogGuard {
 public:
  /// A request to jog `axis` of `channel` continuously at `speed`. True when it must be sent to the channel;
  /// false when it only renews a movement that is being executed.
  bool press(std::uint16_t channel, std::uint8_t axis, double speed, double now);
  /// The movement ended: stopped, or refused.
  void forget(std::uint16_t channel, std::uint8_t axis);
  /// The movements whose time is over, once each: stop them.
  std::vector<std::pair<std::uint16_t, std::uint8_t>> expired(double now);

  bool watching() const { return !held_.empty(); }

 private:
  struct Held {
    double speed = 0;
    double renewed = 0;
  };
  std::map<std::pair<std::uint16_t, std::uint8_t>, Held> held_;
};

}  // namespace trunnion::gateway
