// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_line.hpp"

#include <array>
#include <charconv>

namespace trunnion::language {
namespace {

struct OStatement {
  std::string_view word;
  Statement statement;
};

// A longer word comes before a shorter one that begins it.
constexpr std::array o_statements = {
    OStatement{"SUB", Statement::begin_sub},      OStatement{"ENDSUB", Statement::end_sub},
    OStatement{"CALL", Statement::call_sub},      OStatement{"DO", Statement::begin_until},
    OStatement{"WHILE", Statement::begin_while},  OStatement{"REPEAT", Statement::begin_repeat},
    OStatement{"IF", Statement::begin_if},        OStatement{"ELSEIF", Statement::else_if},
    OStatement{"ELSE", Statement::else_},         OStatement{"ENDIF", Statement::end_if},
    OStatement{"BREAK", Statement::break_loop},   OStatement{"CONTINUE", Statement::continue_loop},
    OStatement{"ENDWHILE", Statement::end_while}, OStatement{"ENDREPEAT", Statement::end_repeat},
    OStatement{"RETURN", Statement::return_sub},
};

bool belongs_to_file(char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || c == '-' || c == '_'; }

}  // namespace

// Digits that blanks divide are joined first.
Decimal LinuxcncScanner::number() {
  Decimal decimal = read_decimal(p_, end_);
  const char* const behind = behind_blanks(decimal.end);
  const bool begun =
      decimal.status == DecimalStatus::missing && p_ != end_ && (*p_ == '-' || *p_ == '+' || *p_ == '.');
  const char* const next = begun ? behind_blanks(p_ + 1) : behind;
  const bool split = (begun || behind != decimal.end) && next != end_ && (is_digit(*next) || *next == '.');
  if (!split) {
    if (decimal.status != DecimalStatus::missing) p_ = behind;
    return decimal;
  }
  std::array<char, 64> joined{};
  std::size_t size = 0;
  const char* p = p_;
  for (; p != end_ && size < joined.size(); p = behind_blanks(p + 1)) {
    const bool first_sign = size == 0 && (*p == '-' || *p == '+');
    if (!first_sign && !is_digit(*p) && *p != '.') break;
    joined[size++] = *p;
  }
  decimal = read_decimal(joined.data(), joined.data() + size);
  const bool whole = decimal.end == joined.data() + size && size < joined.size();
  if (decimal.status == DecimalStatus::ok && !whole) decimal.status = DecimalStatus::missing;
  if (decimal.status == DecimalStatus::ok) p_ = p;
  return decimal;
}

std::optional<OName> read_o_name(LinuxcncScanner& scanner) {
  if (scanner.take('<')) {
    NameHash hash;
    for (; scanner.peek() != '>'; scanner.advance()) {
      if (scanner.at_end()) return std::nullopt;
      hash.add(scanner.peek());
    }
    scanner.advance();
    return OName{hash.key(), 0};
  }
  if (!is_digit(scanner.peek())) return std::nullopt;
  std::uint32_t number = 0;
  for (; is_digit(scanner.peek()); scanner.advance()) {
    number = number * 10 + static_cast<std::uint32_t>(scanner.peek() - '0');
    if (number > highest_o_number) return std::nullopt;
  }
  return OName{number_key(number), number};
}

Statement take_o_statement(LinuxcncScanner& scanner) {
  for (const OStatement& row : o_statements)
    if (scanner.take_word(row.word)) return row.statement;
  return Statement::none;
}

bool ends_o_word(LinuxcncScanner scanner) { return !end_of_o_word(scanner); }

Fault end_of_o_word(LinuxcncScanner& scanner) {
  std::string_view comment;
  while (scanner.peek() == '(') {
    const std::uint16_t at = scanner.offset();
    if (!scanner.take_comment(comment)) return {AlarmNumber::open_comment, at};
  }
  if (scanner.at_end() || scanner.peek() == ';') return {};
  return {AlarmNumber::text_behind_statement, scanner.offset()};
}

Fault read_line_number(LinuxcncScanner& scanner, std::uint16_t at, double& number) {
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  if (decimal.value < 0) return {AlarmNumber::value_range, at};
  number = decimal.value;
  return {};
}

std::size_t o_word_file(std::string_view text, std::span<char> name) {
  LinuxcncScanner scanner(text);
  scanner.advance();  // the O
  const bool named = scanner.take('<');
  std::size_t size = 0;
  for (; named ? scanner.peek() != '>' : is_digit(scanner.peek()); scanner.advance()) {
    char c = scanner.peek();
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    // A name ends with a zero where it is kept.
    if (scanner.at_end() || !belongs_to_file(c) || size + 1 >= name.size() || size + 1 >= FileName{}.size())
      return 0;
    name[size++] = c;
  }
  return size;
}

std::optional<std::uint32_t> o_word_program(std::string_view name) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  if (number == 0 || number > highest_o_number) return std::nullopt;
  return number;
}

}  // namespace trunnion::language
