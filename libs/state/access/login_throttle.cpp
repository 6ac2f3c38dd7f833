// SPDX-License-Identifier: Apache-2.0
#include "access/login_throttle.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::access {
namespace {

// Names of users and addresses have no blanks.
std::string of_name(const std::string& name) { return "name " + name; }
std::string of_peer(const std::string& peer) { return "from " + peer; }
std::string of_both(const std::string& name, const std::string& peer) { return name + " from " + peer; }

}  // namespace

double LoginThrottle::wait(const std::string& key, int free, double now) const {
  const auto found = failures_.find(key);
  if (found == failures_.end() || found->second.count < free) return 0;
  if (now - found->second.last > forgotten_after) return 0;
  const double needed = std::min(longest_wait, std::ldexp(1.0, std::min(found->second.count - free, 10)));
  return std::max(0.0, found->second.last + needed - now);
}

double LoginThrottle::wait(const std::string& name, const std::string& peer, double now) const {
  const auto both = of_both(name, peer);
  const double own = wait(both, free_tries, now);
  if (known_.contains(both)) return own;
  return std::max(
      {own, wait(of_peer(peer), free_tries, now), wait(of_name(name), free_tries_of_strangers, now)});
}

void LoginThrottle::count(const std::string& key, double now) {
  if (failures_.size() >= most && !failures_.contains(key))
    failures_.erase(std::ranges::min_element(failures_, {}, [](const auto& one) { return one.second.last; }));
  auto& failures = failures_[key];
  ++failures.count;
  failures.last = now;
}

void LoginThrottle::failed(const std::string& name, const std::string& peer, double now) {
  std::erase_if(failures_, [&](const auto& one) { return now - one.second.last > forgotten_after; });
  for (const auto& key : {of_both(name, peer), of_peer(peer), of_name(name)}) count(key, now);
}

void LoginThrottle::succeeded(const std::string& name, const std::string& peer, double now) {
  const auto both = of_both(name, peer);
  failures_.erase(both);
  if (known_.size() >= most && !known_.contains(both))
    known_.erase(std::ranges::min_element(known_, {}, [](const auto& one) { return one.second; }));
  known_[both] = now;
}

}  // namespace trunnion::access
