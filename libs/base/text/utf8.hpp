// SPDX-License-Identifier: Apache-2.0
// Text in UTF-8: whether it is, made readable, cut between two of its characters, with small letters.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace trunnion::text {

/// Length of the longest prefix of `text` that is well-formed UTF-8 (Unicode 15, table 3-7).
std::size_t valid_utf8_prefix(std::string_view text);

/// Characters of `text`; a byte that belongs to no well-formed one counts as one.
std::size_t character_count(std::string_view text);

/// Copies whole characters of `text`, as many as fit into `out`, so that a display can show them: bytes that
/// are no UTF-8 as those of Windows-1252, in which old programs are written; control characters, and bytes
/// that it does not have, as ?. Returns the bytes written.
std::size_t copy_readable(std::string_view text, std::span<char> out);

/// `text` where it has at most `most` bytes, otherwise its beginning and " ...", together at most `most`
/// bytes, which are at least four. No character is cut in two.
std::string shortened(std::string text, std::size_t most);

/// a to z in place of A to Z; other characters as they are.
std::string lower_case(std::string text);

}  // namespace trunnion::text
