// SPDX-License-Identifier: Apache-2.0
// Names that contracts had up to version 0.3.0, in recordings and in what operators have written down.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::bus {

/// `text` with the names of today. It may be a topic, a handle, a type or a whole schema: of a message only
/// the names are in it, so that a type whose names alone have changed is read as ever.
std::string with_names_of_today(std::string_view text);

}  // namespace trunnion::bus
