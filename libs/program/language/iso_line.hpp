// SPDX-License-Identifier: Apache-2.0
// What reading a line of the ISO dialect and its outline have in common: heads, block skip, comments.
#pragma once

#include <cstdint>

#include "language/alarms.hpp"
#include "language/block.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {

inline constexpr std::uint32_t highest_label = 99999999;

Fault read_head(Scanner& scanner, Head& head, std::uint32_t& number);
/// Takes / and its level; whether the block is to be skipped.
bool read_skip(Scanner& scanner, SkipLevels skip);
inline bool starts_head(char c) { return c == '%' || letter(c) == 'O'; }
/// Only comments may be there.
Fault end_of_line(Scanner& scanner);
/// Past blanks and comments; false at an open comment.
bool skip_comments(Scanner& scanner);
/// Whether only comments are left.
bool nothing_follows(Scanner scanner);

}  // namespace trunnion::language
