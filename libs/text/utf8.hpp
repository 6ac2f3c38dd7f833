// SPDX-License-Identifier: Apache-2.0
// Checking that text is UTF-8.
#pragma once

#include <string_view>

namespace trunnion::text {

/// Length of the longest prefix of `text` that is well-formed UTF-8 (Unicode 15, table 3-7).
std::size_t valid_utf8_prefix(std::string_view text);

}  // namespace trunnion::text
