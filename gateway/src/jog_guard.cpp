// SPDX-License-Identifier: Apache-2.0
#include "src/jog_guard.hpp"

namespace trunnion::gateway {

bool JogGuard::press(std::uint16_t channel, std::uint8_t axis, double speed, double now) {
  const auto [held, fresh] = held_.try_emplace({channel, axis}, Held{speed, now});
  const bool changed = fresh || held->second.speed != speed;
  held->second = {speed, now};
  return changed;
}

void JogGuard::forget(std::uint16_t channel, std::uint8_t axis) { held_.erase({channel, axis}); }

std::vector<std::pair<std::uint16_t, std::uint8_t>> JogGuard::expired(double now) {
  std::vector<std::pair<std::uint16_t, std::uint8_t>> over;
  for (auto held = held_.begin(); held != held_.end();) {
    if (now - held->second.renewed <= jog_timeout) {
      ++held;
      continue;
    }
    over.push_back(held->first);
    held = held_.erase(held);
  }
  return over;
}

}  // namespace trunnion::gateway
