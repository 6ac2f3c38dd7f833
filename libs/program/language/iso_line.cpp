// SPDX-License-Identifier: Apache-2.0
#include "language/iso_line.hpp"

#include <cmath>

namespace trunnion::language {

Fault read_head(Scanner& scanner, Head& head, std::uint32_t& number) {
  const std::uint16_t at = scanner.offset();
  const bool percent = scanner.peek() == '%';
  scanner.advance();
  scanner.skip_blanks();
  if (scanner.at_end() || !is_digit(scanner.peek())) {
    if (!percent) return {AlarmNumber::number_missing, at};
    head = Head::tape_mark;
    return {};
  }
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  if (decimal.value != std::floor(decimal.value)) return {AlarmNumber::not_an_integer, at};
  head = Head::program;
  number = static_cast<std::uint32_t>(decimal.value);
  return {};
}

bool read_skip(Scanner& scanner, SkipLevels skip) {
  unsigned level = 1;
  scanner.advance();
  if (!scanner.at_end() && scanner.peek() >= '1' && scanner.peek() <= '9') {
    level = static_cast<unsigned>(scanner.peek() - '0');
    scanner.advance();
  }
  scanner.skip_blanks();
  return ((skip >> (level - 1)) & 1u) != 0;
}

Fault end_of_line(Scanner& scanner) {
  while (scanner.more() && scanner.peek() == '(') {
    const std::uint16_t at = scanner.offset();
    if (!scanner.skip_comment()) return {AlarmNumber::open_comment, at};
  }
  if (scanner.at_end() || scanner.peek() == ';') return {};
  return {AlarmNumber::text_behind_statement, scanner.offset()};
}

bool skip_comments(Scanner& scanner) {
  while (scanner.more() && scanner.peek() == '(') {
    if (!scanner.skip_comment()) return false;
  }
  return true;
}

bool nothing_follows(Scanner scanner) {
  return !skip_comments(scanner) || scanner.at_end() || scanner.peek() == ';';
}

}  // namespace trunnion::language
