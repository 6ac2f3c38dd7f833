// SPDX-License-Identifier: Apache-2.0
#include "access/role.hpp"

#include <array>

namespace trunnion::access {

namespace {
constexpr std::array names = {"operator", "setter", "builder", "administrator"};
}

const char* name_of(Role role) { return names.at(static_cast<std::size_t>(role)); }

std::optional<Role> role_from(std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (name == names[i]) return static_cast<Role>(i);
  return {};
}

}  // namespace trunnion::access
