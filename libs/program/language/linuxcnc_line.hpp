// SPDX-License-Identifier: Apache-2.0
// What reading a line of the LinuxCNC dialect and its outline have in common: O words, line numbers,
// comments.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "language/block.hpp"
#include "language/linuxcnc_scanner.hpp"
#include "language/name_key.hpp"

namespace trunnion::language {

inline constexpr std::uint32_t highest_o_number = 99999999;

/// What an O word is called: o100 or o<name>.
struct OName {
  NameKey key = 0;
  std::uint32_t number = 0;  ///< 0 of a name
};

/// Behind the O. Nothing when the name is not closed, the number too large or computed (o[#1], o#1).
std::optional<OName> read_o_name(LinuxcncScanner& scanner);
/// Takes the word behind the name; none when there is no such word.
Statement take_o_statement(LinuxcncScanner& scanner);
/// Only comments follow: a lone O word is the head of a program.
bool ends_o_word(LinuxcncScanner scanner);
/// An alarm when anything but comments follows.
Fault end_of_o_word(LinuxcncScanner& scanner);
/// The number behind an N, which may have a fraction.
Fault read_line_number(LinuxcncScanner& scanner, std::uint16_t at, double& number);

/// The name of the file of the subroutine that the O word at the begin of `text` calls, in small letters; its
/// size, 0 when no file can have it: such a name has letters, digits, - and _ only.
std::size_t o_word_file(std::string_view text, std::span<char> name);
/// The program of such a name, when it is a number: 100 is O0100.
std::optional<std::uint32_t> o_word_program(std::string_view name);

}  // namespace trunnion::language
