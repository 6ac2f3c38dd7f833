// SPDX-License-Identifier: Apache-2.0
// Two gateways read the same cluster, never at the same moment: a difference counts when it lasts.
#pragma once

#include <map>
#include <string>

#include "bus/json.hpp"

namespace trunnion::gateway {

/// Compares two documents value by value, again and again. A value that changes here, as positions in motion
/// do, cannot be compared; it is as soon as it is at rest.
class LastingDifference {
 public:
  static constexpr double duration = 1.5;  ///< s, and at least so many samples in a row:
  static constexpr int samples_in_a_row = 10;

  /// What the running one shows, asked for between `before` and `after`, two samples of our own. `now` in
  /// seconds.
  void sample(const bus::Json& running, const bus::Json& before, const bus::Json& after, double now);
  /// Where a difference has lasted, with both values, the running one's first; empty when there is none.
  const std::string& difference() const { return difference_; }
  /// Has compared for long enough to find what there is to find.
  bool settled(double now) const {
    return samples_ > 1.5 * samples_in_a_row && now - began_ > 1.5 * duration;
  }

 private:
  struct Differing {
    std::string own;
    double since = 0;
    int samples = 0;
  };
  void count(const std::string& path, const std::string& running, const std::string& own, double now);

  std::map<std::string, Differing> differing_;  // by the place in the document
  std::string difference_;
  double began_ = 0;
  int samples_ = 0;
};

}  // namespace trunnion::gateway
