// SPDX-License-Identifier: Apache-2.0
// What reading a line of the ISO dialect and its outline have in common: heads, block skip, comments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "language/alarms.hpp"
#include "language/block.hpp"
#include "language/scanner.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

inline constexpr std::uint32_t highest_label = 99999999;

/// A lone %, which may have a title behind it, %1234, %O1234, O1234, :1234, O<NAME> or <NAME>. A program with
/// a name has number 0, which nothing calls.
Fault read_head(Scanner& scanner, Head& head, std::uint32_t& number);
/// The usual heads, which the reader looks for in every line.
inline bool starts_head(char c) { return c == '%' || letter(c) == 'O'; }
/// These and the others.
inline bool begins_head(char c) { return starts_head(c) || c == ':' || c == '<'; }

/// Whether a line with a head has it as :1234.
bool is_colon_head(std::string_view line);

/// What / and its level make of the text behind them.
struct BlockSkip {
  bool active = false;   ///< a level is switched on
  bool numbered = true;  ///< a level was written
};
constexpr bool is_skip_level(char c) { return c >= '1' && c <= '9'; }
/// Takes / and its level, and those that follow when all of them have one (/1/3): one that is on is enough.
BlockSkip read_skip(Scanner& scanner, SkipLevels skip);

/// Takes `word`, or its first two letters where no third one follows: WH for WHILE.
bool take_abbreviated(Scanner& scanner, std::string_view word);
/// Whether a block can begin here: with a word, a variable, an instruction or a block skip.
bool begins_block(Scanner scanner);

/// Only comments may be there.
Fault end_of_line(Scanner& scanner);
/// Past blanks, comments and what a transmission leaves; false at an open comment.
bool skip_comments(Scanner& scanner);
/// Whether only comments are left.
bool nothing_follows(Scanner scanner);
/// The number that is all of the text; vacant when there is none.
Value number_in(std::string_view text);

/// What is wrong with the number that begins at byte `at` where a word should; null: it is no number.
const char* missing_letter(std::string_view line, std::size_t at);
/// What is wrong with the / at byte `at` when it is the second of two; else null.
const char* no_comment(std::string_view line, std::size_t at);

/// The byte of a ( inside a comment that ends before a ) without a (, or npos.
std::size_t find_nested_comment(std::string_view line);

}  // namespace trunnion::language
