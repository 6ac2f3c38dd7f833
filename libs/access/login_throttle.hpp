// SPDX-License-Identifier: Apache-2.0
// How often a login may be tried.
#pragma once

#include <map>
#include <string>

namespace trunnion::access {

/// After `free_tries` failures of a name or an address the next try must wait: 1 s, then twice as long each
/// time, at most `longest_wait`. A success of a name ends its wait; an hour without a failure ends any.
class LoginThrottle {
 public:
  static constexpr int free_tries = 5;
  static constexpr double longest_wait = 60, forgotten_after = 3600;
  /// Keys that are kept; a further one takes the place of the oldest.
  static constexpr std::size_t most = 4096;

  /// Seconds until `key` may be tried, 0 = now. `now` in seconds of a monotonic clock.
  double wait(const std::string& key, double now) const;
  void failed(const std::string& key, double now);
  void succeeded(const std::string& key) { failures_.erase(key); }

 private:
  struct Failures {
    int count = 0;
    double last = 0;
  };
  std::map<std::string, Failures> failures_;
};

}  // namespace trunnion::access
