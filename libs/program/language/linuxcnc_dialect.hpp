// SPDX-License-Identifier: Apache-2.0
// Blocks as LinuxCNC writes them.
#pragma once

#include "language/block.hpp"

namespace trunnion::language {

/// Reads the language of LinuxCNC 2.9 (docs/linuxcnc.md has the codes and parameters):
/// - blanks mean nothing outside comments, not even within numbers; letters in either case;
/// - `( )` and `;` are comments; the last one of a block may be an order: (MSG,..), (DEBUG,..), (PRINT,..)
/// show
///   a message, the latter two with the values of #5 and #<name> in them, (ABORT,..) is an alarm;
/// - `/` at the start of a line makes a block skippable, at level 1; N comes first and is no target of jumps;
///   a lone % marks the ends of the text, which ends with M2, M30, M99 or % and not without one of them;
/// - the value of a word or an assignment is a number, #parameter, [expression] or function with a sign; all
///   of a block are read before any of its parameters is written;
/// - o100 or o<name> and sub, endsub, return, call; if, elseif, else, endif; while, endwhile; do, while;
///   repeat, endrepeat; break, continue: alone in its block. Loops and branches are closed by the same name,
///   each within the other; a subroutine has #1 to #30 and its own local names. A call finds its subroutine
///   in its text, in the started one, or in the file of that name;
/// - a lone o100 begins a numbered program, which M98 calls and M99 ends.
class LinuxcncDialect final : public Dialect {
 public:
  DialectRules rules() const override;
  /// The remedies of that table are ISO codes.
  bool names_foreign_words() const override { return false; }
  Fault read_block(std::string_view line, SkipLevels skip, Variables& variables, Block& block) const override;
  Fault read_condition(std::string_view line, std::uint16_t rest, const Variables& variables,
                       bool& condition) const override;
  Outline outline(std::string_view line, SkipLevels skip) const override;
};

}  // namespace trunnion::language
