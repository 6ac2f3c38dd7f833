// SPDX-License-Identifier: Apache-2.0
// Blocks as HNC-8 and Fanuc controls write them.
#pragma once

#include "language/block.hpp"

namespace trunnion::language {

/// Reads ISO 6983 words and macro statements as HNC-8 and Fanuc controls do (docs/program-text.md):
/// - blanks and tabs may be between and inside words, or be left out; letters in either case;
/// - a number means the same with and without a point: mm (inch), degrees, or the unit of its letter;
/// - the number of a word may be #variable or [expression], with a sign; a word of a vacant variable is left
///   out, and a result within 1e-9 of a whole number is that number;
/// - `( )` and `;` begin comments, the latter to the end of the line; a line that begins with `*` is one.
///   They may hold any bytes, because old programs hold comments in old encodings; outside them only ASCII
///   has a meaning;
/// - heads as in read_head() begin a program, a lone `%` marks the ends of the tape; what is behind `/` or
///   `/n` is left out and not read further when that level is on;
/// - each letter once, but two T, at most 20 G and 8 M, and in a macro call (behind G65 or G66) ten I, J and
///   K. Which of two would be meant cannot be known;
/// - assignments and instructions are alone in their block, except for N; several assignments may follow
///   each other, of which one to a system variable is the last.
class IsoDialect final : public Dialect {
 public:
  Fault read_block(std::string_view line, SkipLevels skip, Variables& variables, Block& block) const override;
  Fault read_condition(std::string_view line, std::uint16_t rest, const Variables& variables,
                       bool& condition) const override;
  Outline outline(std::string_view line, SkipLevels skip) const override;
  Leader leader(std::string_view line) const override;
};

}  // namespace trunnion::language
