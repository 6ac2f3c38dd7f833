// The HNC-8 / Fanuc way of writing blocks.
#pragma once

#include "language/block.hpp"

namespace trunnion::language {

/// Reads ISO 6983 words as HNC-8 and Fanuc controls do:
/// - blanks and tabs may stand between and inside words (between letter and number) or be left out; letters
/// in
///   either case;
/// - a number means the same with and without a point: mm (inch), degrees, or the unit of its letter;
/// - `( )` and `;` begin comments, the latter to the end of the line; both must be UTF-8;
/// - `%1234`, `O1234` begin a program, a lone `%` marks the ends of the tape, `/` first makes a block
/// skippable;
/// - each letter once, but at most 12 G and 4 M.
/// A block that is skipped is still read, so an error in it is an alarm whatever the switch says.
class IsoDialect final : public Dialect {
 public:
  Fault read_block(std::string_view line, Block& block) const override;
  std::optional<std::uint32_t> program_head(std::string_view line) const override;
};

}  // namespace trunnion::language
