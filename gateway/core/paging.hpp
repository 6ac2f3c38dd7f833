// SPDX-License-Identifier: Apache-2.0
// Parts of long lists.
#pragma once

#include <cstddef>
#include <string>

#include "bus/json.hpp"

namespace trunnion::gateway {

/// A whole number of the query, `fallback` when it is not there. Throws BadRequest.
std::size_t count_in_query(const std::string& query, const char* name, std::size_t fallback);

/// Leaves of `list` what offset and limit of the query ask for, everything without them. Returns how many it
/// had. Throws BadRequest.
std::size_t cut_to_page(bus::Json& list, const std::string& query);

}  // namespace trunnion::gateway
