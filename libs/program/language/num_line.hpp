// SPDX-License-Identifier: Apache-2.0
// Heads, numbers and structures of the NUM dialect's lines.
#pragma once

#include <cstdint>

#include "language/block.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {

/// %n or %n.i as the number of a program: n and i * program_tenth.
Fault program_of(double value, std::uint16_t at, std::uint32_t& number);
/// A % and its number.
Fault read_num_head(Scanner& scanner, std::uint32_t& number);
/// The number behind an N.
Fault read_sequence_number(Scanner& scanner, std::uint16_t at, std::uint32_t& number);
/// Past blanks and comments; false at an open comment.
bool skip_remarks(Scanner& scanner);
/// Only comments may be there.
Fault end_of_num_line(Scanner& scanner);
/// Takes the word that opens, divides or closes a structure.
Statement take_structure(Scanner& scanner);

}  // namespace trunnion::language
