// Two gateways look at the same cluster, never at the same moment: what differs counts when it lasts.
#pragma once

#include <map>
#include <string>

#include "bus/json.hpp"

namespace trunnion::gateway {

/// Compares two documents value by value, again and again. Values that both change all the time, as positions
/// in motion do, cannot be compared; they are as soon as one of the two rests.
class LastingDifference {
 public:
  static constexpr double patience = 1;  ///< s

  /// What both show at `now`, in seconds.
  void look(const bus::Json& running, const bus::Json& own, double now);
  /// Where a difference has lasted, with both values, the running one's first; empty when there is none.
  const std::string& difference() const { return difference_; }
  /// Has looked for long enough to find what there is to find.
  bool settled(double now) const { return looks_ > 0 && now - began_ > 1.5 * patience; }

 private:
  struct Value {
    std::string running, own;
    double running_since = 0, own_since = 0, equal_at = 0;
  };
  void look_at(const std::string& path, const std::string& running, const std::string& own, double now);

  std::map<std::string, Value> values_;
  std::string difference_;
  double began_ = 0;
  int looks_ = 0;
};

}  // namespace trunnion::gateway
