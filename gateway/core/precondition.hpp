// SPDX-License-Identifier: Apache-2.0
// If-Match and If-None-Match of an upload (RFC 9110, 13.1), by the revision of the program.
#pragma once

#include <string>

#include "contracts/types.hpp"

namespace trunnion::gateway {

/// A revision as ETag.
std::string entity_tag(std::uint64_t revision);
/// Changes with the active and with the pending values, which have no revision.
std::string entity_tag(const idl::parameters::ParameterSet& set);

struct Precondition {
  std::string if_match;       ///< a revision in quotes or *, empty = none
  std::string if_none_match;  ///< *, empty = none

  /// Empty when the condition holds, else why not. `programs` is null while there is no list, which fails
  /// every condition. `lately` is the revision that was stored just now and that the list may not have yet, 0
  /// = none.
  std::string failed(const idl::program::ProgramList* programs, const std::string& name,
                     std::uint64_t lately = 0) const;
};

}  // namespace trunnion::gateway
