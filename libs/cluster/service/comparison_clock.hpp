// SPDX-License-Identifier: Apache-2.0
// When what a process has read from files is compared with what another one publishes that writes them: the
// two never come at the same moment, so a difference counts once it has lasted.
#pragma once

#include <exception>
#include <string>

#include "service/node.hpp"

namespace trunnion::service {

class ComparisonClock {
 public:
  /// Compares while there is news or a difference, ten times a second. `compare()` returns what differs,
  /// or nothing; what it throws is a difference as well. `now` in seconds.
  template <class Compare>
  void poll(bool news, double now, Compare compare) {
    pending_ = pending_ || news;
    if (!pending_ || now - compared_ < period || lasting()) return;
    compared_ = now;
    try {
      difference_ = compare();
    } catch (const std::exception& e) {
      difference_ = e.what();
    }
    if (difference_.empty()) {
      pending_ = false;
      equal_ = true;
      since_ = 0;
    } else if (since_ == 0) {
      since_ = now;
    }
  }

  /// Of the standby that compares: in step when there was no difference, until there is one that lasts.
  Health health() const {
    Health health;
    health.lifecycle = idl::service::Lifecycle::INACTIVE;
    if (lasting()) health.difference = difference_;
    health.in_step = equal_ && !pending_;
    return health;
  }

 private:
  static constexpr double period = 0.1, timeout = 1;  // s
  bool lasting() const { return since_ > 0 && compared_ - since_ >= timeout; }

  bool pending_ = true, equal_ = false;
  double compared_ = -1, since_ = 0;
  std::string difference_;
};

}  // namespace trunnion::service
