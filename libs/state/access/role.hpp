// SPDX-License-Identifier: Apache-2.0
// What a user may do: each role includes those before it.
#pragma once

#include <optional>
#include <string_view>

namespace trunnion::access {

enum class Role {
  machine_operator,  ///< runs programs, moves axes
  setter,            ///< tools, work offsets, programs, parameters of access user
  builder,           ///< parameters of access builder
  administrator      ///< users
};

/// operator, setter, builder or administrator.
const char* name_of(Role role);
std::optional<Role> role_from(std::string_view name);

}  // namespace trunnion::access
