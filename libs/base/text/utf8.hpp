// SPDX-License-Identifier: Apache-2.0
// Text in UTF-8: whether it is, cut between two of its characters, with small letters.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trunnion::text {

/// Length of the longest prefix of `text` that is well-formed UTF-8 (Unicode 15, table 3-7).
std::size_t valid_utf8_prefix(std::string_view text);

/// `text` where it has at most `most` bytes, otherwise its beginning and " ...", together at most `most`
/// bytes, which are at least four. No character is cut in two.
std::string shortened(std::string text, std::size_t most);

/// a to z in place of A to Z; other characters as they are.
std::string lower_case(std::string text);

}  // namespace trunnion::text
