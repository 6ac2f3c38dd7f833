// SPDX-License-Identifier: Apache-2.0
#include "core/precondition.hpp"

#include <algorithm>

#include "bus/codec.hpp"
#include "storage/crc32.hpp"

namespace trunnion::gateway {

std::string entity_tag(std::uint64_t revision) { return '"' + std::to_string(revision) + '"'; }

std::string entity_tag(const idl::parameters::ParameterSet& set) {
  bus::Bytes pending;
  bus::encode(idl::parameters::ParameterSet{0, 0, 0, {}, set.pending}, pending);
  return '"' + std::to_string(set.revision) + '.' + std::to_string(storage::crc32(0, pending)) + '"';
}

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
  if (if_match == "*" || if_match == entity_tag(newest)) return {};
  return name + " has revision " + revision + " by now, and the change was made on " + if_match;
}

}  // namespace trunnion::gateway
