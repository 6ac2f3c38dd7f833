// SPDX-License-Identifier: Apache-2.0
// A stored program by the name that a user types.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "contracts/types.hpp"

namespace trunnion::cluster {

/// The stored program `name`; "part" and "part.nc" are alike where only one of them is stored.
inline std::optional<idl::program::ProgramEntry> find_program(const idl::program::ProgramList& list,
                                                              const std::string& name) {
  constexpr std::string_view suffix = ".nc";
  for (const auto& wanted : {name, name + std::string(suffix),
                             name.ends_with(suffix) ? name.substr(0, name.size() - suffix.size()) : name}) {
    const auto found = std::ranges::find(list.programs, wanted, &idl::program::ProgramEntry::name);
    if (found != list.programs.end()) return *found;
  }
  return std::nullopt;
}

}  // namespace trunnion::cluster
