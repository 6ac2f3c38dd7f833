// SPDX-License-Identifier: Apache-2.0
// Blocks as NUM 1020 to 1060 T controls write them.
#pragma once

#include "language/block.hpp"

namespace trunnion::language {

/// Reads the part of NUM's language that the addition 938989 to the programming manual T uses:
/// - blanks may be left out between words; letters in either case; `( )` are comments, which may hold any
///   bytes; `$` shows the rest of the line as a message, nothing behind it shows none;
/// - `%n` and `%n.i` (n to 99999, i to 9) begin a program at the start of a line; `/` there makes a block
///   skippable, at level 1; N is the first word;
/// - G as in num_codes, M but for 30, 98 and 99, words of the axes, F S T R, H of G77, K, J, EC, EX and EZ of
///   threads, K, EK, EH and ER of G84, K of G39+; the number of a word but G and N may be a value of
///   NumExpressionReader that begins with L or E, with a sign; behind G159 a letter of an axis needs none;
/// - `L0=2 E80001=L0+1 G1 X10`: assignments and words in one block, carried out from left to right, the words
///   with what was assigned before them;
/// - IF condition THEN, ELSE, ENDI; WHILE condition DO, ENDW: first in their line; behind THEN and DO may be
///   words, assignments and a message, behind the others nothing; the end of a program closes an IF behind
///   its ELSE;
/// - E94125=24 orders the synchronization of a spindle, EC, in a block without a thread, its angle: the block
///   waits until both spindles are known to be homed. Values that the drive knows (E93525) are read at rest,
///   before their block;
/// - G77 Hn.i calls a program, behind the words of its block; the end of its text, the next head or M2 ends
///   it. Program 9990.9 homes the axis of L0 unless it is stored. G79 Nn and G79 condition Nn jump, alone in
///   their block. G39+ ends the started program wherever it is.
/// What other functions take, EA EB ES among it, is an alarm with its name.
class NumDialect final : public Dialect {
 public:
  DialectRules rules() const override;
  /// Its own alarms name what NUM controls have.
  bool names_foreign_words() const override { return false; }
  Fault read_block(std::string_view line, SkipLevels skip, Variables& variables, Block& block) const override;
  /// There is no ELSEIF.
  Fault read_condition(std::string_view line, std::uint16_t rest, const Variables& variables,
                       bool& condition) const override;
  Outline outline(std::string_view line, SkipLevels skip) const override;
};

}  // namespace trunnion::language
