// SPDX-License-Identifier: Apache-2.0
// A clock that stands still while the process does.
#pragma once

#include <algorithm>

namespace trunnion::service {

/// The time during which this process ran. A process that was suspended, or whose computer paused, has
/// received nothing meanwhile; silence of others is measured by this time.
class RunningTime {
 public:
  static constexpr double longest_pause = 0.1;  ///< s; what lies between two calls counts as no more

  /// To be called in every turn of the process's loop with a monotonic time in seconds. Returns now().
  double advance(double monotonic) {
    if (last_ > 0) now_ += std::clamp(monotonic - last_, 0.0, longest_pause);
    last_ = monotonic;
    return now_;
  }
  /// Seconds, as of the last advance(). The first value is greater than 0.
  double now() const { return now_; }

 private:
  double now_ = 1, last_ = 0;
};

}  // namespace trunnion::service
