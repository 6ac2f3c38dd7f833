// SPDX-License-Identifier: Apache-2.0
// Roles as requests on the bus carry them (ParameterRequest); access::Role has the administrator besides.
#pragma once

#include <cstdint>

namespace trunnion::machine::role {

inline constexpr std::uint8_t machine_operator = 0, setter = 1, builder = 2;

constexpr const char* name(std::uint8_t role) {
  return role == machine_operator ? "operator" : role == setter ? "setter" : "builder";
}

}  // namespace trunnion::machine::role
