// SPDX-License-Identifier: Apache-2.0
// Blocks as HNC-8 and Fanuc controls write them.
#pragma once

#include "language/block.hpp"

namespace trunnion::language {

/// Reads ISO 6983 words and macro statements as HNC-8 and Fanuc controls do:
/// - blanks and tabs may be between and inside words (between letter and number) or be left out; letters
/// in
///   either case;
/// - a number means the same with and without a point: mm (inch), degrees, or the unit of its letter;
/// - the number of a word may be #variable or [expression], with a sign; a word of a vacant variable is left
/// out, and
///   a result within 1e-9 of a whole number is that number;
/// - `( )` and `;` begin comments, the latter to the end of the line; a line that begins with `*` is a
/// comment. Comments
///   may hold any bytes, because old programs hold comments in old encodings; outside them only ASCII has a
///   meaning;
/// - `%1234`, `O1234` begin a program, a lone `%` marks the ends of the tape, `/` or `/n` first, or behind N,
/// makes a
///   block skippable; a block that is skipped is not read further;
/// - each letter once, but at most 12 G and 8 M, and in a macro call (behind G65 or G66) ten I, J and K.
/// Which of two
///   would be meant cannot be known;
/// - assignments and instructions are alone in their block, except for N; several assignments may follow each
///   other, of which one to a system variable is the last.
class IsoDialect final : public Dialect {
 public:
  Fault read_block(std::string_view line, SkipLevels skip, Variables& variables, Block& block) const override;
  Fault read_condition(std::string_view line, std::uint16_t rest, const Variables& variables,
                       bool& condition) const override;
  Outline outline(std::string_view line, SkipLevels skip) const override;
  Leader leader(std::string_view line) const override;
};

}  // namespace trunnion::language
