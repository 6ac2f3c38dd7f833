// SPDX-License-Identifier: Apache-2.0
#include "language/print_line.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "language/expression.hpp"
#include "text/utf8.hpp"

namespace trunnion::language {
namespace {

constexpr unsigned most_places = 9;

/// The two digits of [53].
Fault read_places(Scanner& scanner, std::uint16_t at, unsigned& before, unsigned& behind) {
  const Fault fault{AlarmNumber::print_places, at};
  if (!scanner.take('[')) return fault;
  for (unsigned* const places : {&before, &behind}) {
    if (!scanner.more() || !is_digit(scanner.peek())) return fault;
    *places = static_cast<unsigned>(scanner.peek() - '0');
    scanner.advance();
  }
  const unsigned sum = before + behind;
  return scanner.take(']') && sum >= 1 && sum <= most_places ? Fault{} : fault;
}

/// Of the character at `scanner`: as it is printed.
std::string_view printed(Scanner& scanner) {
  constexpr std::size_t longest_character = 4;
  const std::string_view rest = scanner.rest().substr(0, longest_character);
  const auto first = static_cast<unsigned char>(rest[0]);
  const std::size_t valid = text::valid_utf8_prefix(rest);
  std::size_t bytes = 1;
  while (bytes < valid && (static_cast<unsigned char>(rest[bytes]) & 0xc0u) == 0x80u) ++bytes;
  scanner.advance(bytes);
  if (first == '*' || first == '\t') return " ";
  return valid == 0 || first < 0x20 || first == 0x7f ? std::string_view("?") : rest.substr(0, bytes);
}

}  // namespace

bool PrintLine::add(std::string_view part) {
  if (part.size() > longest - size_) return false;
  std::copy(part.begin(), part.end(), text_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += part.size();
  return true;
}

bool PrintLine::add(double value, unsigned before, unsigned behind, bool blanks) {
  std::array<char, 340> digits{};  // the largest double has 309 before the point
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), std::abs(value),
                                 std::chars_format::fixed, static_cast<int>(behind))
                       .ptr;
  const std::string_view number(digits.data(), static_cast<std::size_t>(end - digits.data()));
  const bool zero = number.find_first_not_of("0.") == std::string_view::npos;
  const bool negative = value < 0 && !zero;
  const std::size_t whole = behind == 0 ? number.size() : number.size() - behind - 1;
  if (negative || blanks) {
    if (!add(negative ? "-" : " ")) return false;
  }
  for (std::size_t place = whole; blanks && place < before; ++place)
    if (!add(" ")) return false;
  return add(number);
}

Fault read_print(Scanner& scanner, const Variables& variables, PrintLine& line) {
  line.clear();
  scanner.skip_blanks();
  const std::uint16_t begin = scanner.offset();
  if (!scanner.take('[')) return {AlarmNumber::operand_missing, begin};
  while (!scanner.at_end() && scanner.peek() != ']') {
    const std::uint16_t at = scanner.offset();
    bool room = true;
    if (scanner.peek() == '#') {
      scanner.advance();
      double number = 0;
      Value value;
      unsigned before = 0, behind = 0;
      if (const Fault fault = ExpressionReader(scanner, variables).variable_number(number)) return fault;
      if (const AlarmNumber alarm = variables.read(number, value); alarm != AlarmNumber::none)
        return {alarm, at};
      if (const Fault fault = read_places(scanner, at, before, behind)) return fault;
      room = line.add(value.number, before, behind, variables.prints_blanks());
    } else {
      room = line.add(printed(scanner));
    }
    if (!room) return {AlarmNumber::print_too_long, at};
  }
  return scanner.take(']') ? Fault{} : Fault{AlarmNumber::bracket_open, begin};
}

}  // namespace trunnion::language
