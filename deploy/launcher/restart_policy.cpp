// SPDX-License-Identifier: Apache-2.0
#include "restart_policy.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::launcher {

void RestartPolicy::started(double now) {
  started_ = heard_ = now;
  beaten_ = false;
}

void RestartPolicy::beat(double now) {
  heard_ = now;
  beaten_ = true;
}

Pulse RestartPolicy::pulse(double now) const {
  const double silence = now - heard_;
  if (!beaten_) return silence > first_beat_within ? Pulse::hung : Pulse::beating;
  return silence > hung_after ? Pulse::hung : silence > silent_after ? Pulse::silent : Pulse::beating;
}

void RestartPolicy::ended(double now) {
  if (now - started_ > short_life) {
    short_lives_ = 0;
    start_at_ = now;
    return;
  }
  ++short_lives_;
  start_at_ =
      now + (gave_up() ? rare_delay : std::min(longest_delay, first_delay * std::exp2(short_lives_ - 1)));
}

void RestartPolicy::retry() {
  if (!gave_up()) return;
  short_lives_ = 0;
  start_at_ = 0;
}

}  // namespace trunnion::launcher
