// SPDX-License-Identifier: Apache-2.0
#include "language/num_line.hpp"

#include <cmath>

#include "language/macro_call.hpp"

namespace trunnion::language {
namespace {

constexpr double highest_sequence_number = 99999999;

}  // namespace

Fault program_of(double value, std::uint16_t at, std::uint32_t& number) {
  const double tenths = std::round(value * 10);
  if (std::abs(value * 10 - tenths) > 1e-6) return {AlarmNumber::not_an_integer, at};
  if (!(tenths >= 10 && tenths <= 999999)) return {AlarmNumber::value_range, at};
  const auto whole = static_cast<std::uint32_t>(tenths);
  number = whole / 10 + whole % 10 * program_tenth;
  return {};
}

Fault read_num_head(Scanner& scanner, std::uint32_t& number) {
  const std::uint16_t at = scanner.offset();
  scanner.advance();
  scanner.skip_blanks();
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  return program_of(decimal.value, at, number);
}

Fault read_sequence_number(Scanner& scanner, std::uint16_t at, std::uint32_t& number) {
  scanner.skip_blanks();
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  if (decimal.value != std::floor(decimal.value)) return {AlarmNumber::not_an_integer, at};
  if (decimal.value < 0 || decimal.value > highest_sequence_number) return {AlarmNumber::value_range, at};
  number = static_cast<std::uint32_t>(decimal.value);
  return {};
}

bool skip_remarks(Scanner& scanner) {
  while (scanner.more() && scanner.peek() == '(') {
    if (!scanner.skip_comment()) return false;
  }
  return true;
}

Fault end_of_num_line(Scanner& scanner) {
  if (!skip_remarks(scanner)) return {AlarmNumber::open_comment, scanner.offset()};
  return scanner.at_end() ? Fault{} : Fault{AlarmNumber::text_behind_statement, scanner.offset()};
}

Statement take_structure(Scanner& scanner) {
  if (scanner.take_word("IF")) return Statement::begin_if;
  if (scanner.take_word("ELSE")) return Statement::else_;
  if (scanner.take_word("ENDI")) return Statement::end_if;
  if (scanner.take_word("WHILE")) return Statement::begin_while;
  if (scanner.take_word("ENDW")) return Statement::end_while;
  return Statement::none;
}

}  // namespace trunnion::language
