// SPDX-License-Identifier: Apache-2.0
#include "core/lasting_difference.hpp"

#include <set>

namespace trunnion::gateway {
namespace {

std::string value_at(const bus::Json& flat, const std::string& path) {
  const auto found = flat.find(path);
  return found != flat.end() ? found->dump() : "nothing";
}

}  // namespace

void LastingDifference::sample(const bus::Json& running, const bus::Json& before, const bus::Json& after,
                               double now) {
  if (samples_++ == 0) began_ = now;
  const auto theirs = running.flatten(), first = before.flatten(), last = after.flatten();
  std::set<std::string> paths;
  for (const auto* flat : {&theirs, &first, &last})
    for (const auto& [path, value] : flat->items()) paths.insert(path);
  std::erase_if(differing_, [&](const auto& one) { return !paths.contains(one.first); });
  for (const auto& path : paths) {
    const auto here = value_at(theirs, path), own = value_at(last, path), earlier = value_at(first, path);
    if (earlier != own || here == own)
      differing_.erase(path);
    else
      count(path, here, own, now);
  }
}

void LastingDifference::count(const std::string& path, const std::string& running, const std::string& own,
                              double now) {
  auto& one = differing_[path];
  if (one.samples == 0 || one.own != own) one = {own, now, 0};
  ++one.samples;
  if (difference_.empty() && one.samples >= samples_in_a_row && now - one.since >= duration)
    difference_ = (path.empty() ? "all" : path.substr(1)) + ": " + running + " and " + own;
}

}  // namespace trunnion::gateway
