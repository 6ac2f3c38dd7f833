// SPDX-License-Identifier: Apache-2.0
// How often a login may be tried.
#pragma once

#include <map>
#include <string>

namespace trunnion::access {

/// After `free_tries` failures of a name from an address, of all names from an address, or
/// `free_tries_of_strangers` of a name from everywhere, the next try must wait: 1 s, then twice as long each
/// time, at most `longest_wait`; an hour without a failure ends the wait. An address from which the name has
/// logged in before waits for its own failures of that name only, so nobody locks it out from elsewhere.
class LoginThrottle {
 public:
  static constexpr int free_tries = 5, free_tries_of_strangers = 100;
  static constexpr double longest_wait = 60, forgotten_after = 3600;
  /// Failures and successes that are kept; a further one takes the place of the oldest.
  static constexpr std::size_t most = 4096;

  /// Seconds until `name` may be tried from the address `peer`, 0 = now. `now` in seconds of a monotonic
  /// clock.
  double wait(const std::string& name, const std::string& peer, double now) const;
  void failed(const std::string& name, const std::string& peer, double now);
  void succeeded(const std::string& name, const std::string& peer, double now);

 private:
  struct Failures {
    int count = 0;
    double last = 0;
  };
  double wait(const std::string& key, int free, double now) const;
  void count(const std::string& key, double now);
  std::map<std::string, Failures> failures_;
  std::map<std::string, double> known_;  ///< when a name has logged in from an address
};

}  // namespace trunnion::access
