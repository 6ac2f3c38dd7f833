// SPDX-License-Identifier: Apache-2.0
#include "access/login_throttle.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::access {

double LoginThrottle::wait(const std::string& key, double now) const {
  const auto found = failures_.find(key);
  if (found == failures_.end() || found->second.count < free_tries) return 0;
  if (now - found->second.last > forgotten_after) return 0;
  const double needed =
      std::min(longest_wait, std::ldexp(1.0, std::min(found->second.count - free_tries, 10)));
  return std::max(0.0, found->second.last + needed - now);
}

void LoginThrottle::failed(const std::string& key, double now) {
  std::erase_if(failures_, [&](const auto& one) { return now - one.second.last > forgotten_after; });
  if (failures_.size() >= most && !failures_.contains(key))
    failures_.erase(std::ranges::min_element(failures_, {}, [](const auto& one) { return one.second.last; }));
  auto& failures = failures_[key];
  ++failures.count;
  failures.last = now;
}

}  // namespace trunnion::access
