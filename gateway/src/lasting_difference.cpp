#include "src/lasting_difference.hpp"

namespace trunnion::gateway {
namespace {

constexpr const char* absent = "nothing";

}  // namespace

void LastingDifference::look(const bus::Json& running, const bus::Json& own, double now) {
  if (looks_++ == 0) began_ = now;
  const auto here = running.flatten(), there = own.flatten();
  std::erase_if(values_, [&](const auto& value) {
    return !here.contains(value.first) && !there.contains(value.first);
  });
  for (const auto& [path, value] : here.items()) {
    const auto other = there.find(path);
    look_at(path, value.dump(), other != there.end() ? other->dump() : absent, now);
  }
  for (const auto& [path, value] : there.items())
    if (!here.contains(path)) look_at(path, absent, value.dump(), now);
}

void LastingDifference::look_at(const std::string& path, const std::string& running, const std::string& own,
                                double now) {
  const auto [found, fresh] = values_.try_emplace(path);
  auto& value = found->second;
  if (fresh || value.running != running) value.running = running, value.running_since = now;
  if (fresh || value.own != own) value.own = own, value.own_since = now;
  if (fresh || running == own) value.equal_at = now;
  const bool one_rests = now - value.running_since >= patience || now - value.own_since >= patience;
  if (difference_.empty() && now - value.equal_at >= patience && one_rests)
    difference_ = (path.empty() ? "all" : path.substr(1)) + ": " + running + " and " + own;
}

}  // namespace trunnion::gateway
