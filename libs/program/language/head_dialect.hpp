// SPDX-License-Identifier: Apache-2.0
// In which dialect a text is written: its head says so, else its name, else the channel.
#pragma once

#include <cstdint>
#include <string_view>

#include "language/environment.hpp"

namespace trunnion::language {

/// What one line of a text's head says. The head is what comes before the first block that does something:
/// marks of the tape, program numbers, sequence numbers and comments.
struct HeadLine {
  enum class Kind : std::uint8_t {
    open,     ///< nothing yet: the next line may belong to the head, too
    closed,   ///< a block that does something: the head names no dialect
    named,    ///< `dialect`
    unknown,  ///< a name that is no dialect's, at `offset`
  };
  Kind kind = Kind::open;
  ProgramDialect dialect = ProgramDialect::iso;
  std::uint16_t offset = 0;  ///< byte of the line
};

/// Reads `(DIALECT: HAAS)` in letters of either case, and `; DIALECT: HAAS` and `* DIALECT: HAAS`, which
/// comment the rest of a line. No dialect is needed to find it.
HeadLine read_head_line(std::string_view line);

/// The dialect of a text whose head names none: that which it has whatever the machine is, else that of its
/// name, else that of the channel.
ProgramDialect dialect_without_head(const TextSource& text, const Environment& environment);

}  // namespace trunnion::language
