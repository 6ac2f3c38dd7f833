// SPDX-License-Identifier: Apache-2.0
#include "access/sessions.hpp"

#include <algorithm>

#include "access/secrets.hpp"

namespace trunnion::access {

void Sessions::begin(const std::string& secret, Identity identity, double now) {
  std::erase_if(sessions_, [&](const auto& one) { return is_over(one.second, now); });
  if (sessions_.size() >= most)
    sessions_.erase(std::ranges::min_element(sessions_, {}, [](const auto& one) { return one.second.used; }));
  sessions_[digest(secret)] = {std::move(identity), now, now};
}

std::optional<Identity> Sessions::find(std::string_view secret, double now) {
  const auto found = sessions_.find(digest(secret));
  if (found == sessions_.end()) return {};
  auto& session = found->second;
  if (is_over(session, now)) {
    sessions_.erase(found);
    return {};
  }
  session.used = now;
  return session.identity;
}

std::optional<Identity> Sessions::look(std::string_view secret, double now) const {
  const auto found = sessions_.find(digest(secret));
  if (found == sessions_.end() || is_over(found->second, now)) return {};
  return found->second.identity;
}

void Sessions::end(std::string_view secret) { sessions_.erase(digest(secret)); }

void Sessions::end_of(std::string_view name) {
  std::erase_if(sessions_, [&](const auto& one) { return one.second.identity.name == name; });
}

}  // namespace trunnion::access
