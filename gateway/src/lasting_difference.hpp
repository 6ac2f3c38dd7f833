// Two gateways look at the same cluster, never at the same moment: what differs counts when it lasts.
#pragma once

#include <map>
#include <string>

#include "bus/json.hpp"

namespace trunnion::gateway {

/// Compares two documents value by value, again and again. A value that is on the move here, as positions in
/// motion are, cannot be compared; it is as soon as it rests.
class LastingDifference {
 public:
  static constexpr double patience = 1.5;  ///< s, and at least so many looks in a row:
  static constexpr int looks_in_a_row = 10;

  /// What the running one shows, asked for between `before` and `after`, two looks of our own. `now` in
  /// seconds.
  void look(const bus::Json& running, const bus::Json& before, const bus::Json& after, double now);
  /// Where a difference has lasted, with both values, the running one's first; empty when there is none.
  const std::string& difference() const { return difference_; }
  /// Has looked for long enough to find what there is to find.
  bool settled(double now) const { return looks_ > 1.5 * looks_in_a_row && now - began_ > 1.5 * patience; }

 private:
  struct Differing {
    std::string own;
    double since = 0;
    int looks = 0;
  };
  void look_at(const std::string& path, const std::string& running, const std::string& own, double now);

  std::map<std::string, Differing> differing_;  // by the place in the document
  std::string difference_;
  double began_ = 0;
  int looks_ = 0;
};

}  // namespace trunnion::gateway
