// SPDX-License-Identifier: Apache-2.0
#include "src/precondition.hpp"

#include <algorithm>

namespace trunnion::gateway {

std::string Precondition::failed(const idl::program::ProgramList* programs, const std::string& name,
                                 std::uint64_t lately) const {
  if (if_match.empty() && if_none_match.empty()) return {};
  if (programs == nullptr) return "the program service has not published yet";
  auto newest = lately;
  for (const auto& one : programs->programs)
    if (one.name == name) newest = std::max(newest, one.revision);
  if (newest == 0) return if_match.empty() ? "" : "there is no program " + name;
  const auto revision = std::to_string(newest);
  if (!if_none_match.empty()) return name + " is stored already, revision " + revision;
  if (if_match == "*" || if_match == '"' + revision + '"') return {};
  return name + " has revision " + revision + " by now, and the change was made on " + if_match;
}

}  // namespace trunnion::gateway
