// SPDX-License-Identifier: Apache-2.0
#include "language/computed_word.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "language/expression.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {
namespace {

/// The value of the word itself is at fault.
bool is_of_value(AlarmNumber number) {
  switch (number) {
    case AlarmNumber::not_an_integer:
    case AlarmNumber::value_range:
    case AlarmNumber::feed_not_positive:
    case AlarmNumber::arc_radius_zero:
    case AlarmNumber::arc_radius_too_small:
    case AlarmNumber::tool_length_unknown:
    case AlarmNumber::tool_undefined:
    case AlarmNumber::tool_unknown:
    case AlarmNumber::subprogram_missing:
      return true;
    default:
      return false;
  }
}

/// The letter of the word that is missing, or 0.
char missing_word(const Fault& fault) {
  if (fault.number == AlarmNumber::feed_missing) return 'F';
  if (fault.number != AlarmNumber::missing_word || fault.detail == nullptr) return '\0';
  constexpr std::string_view begin = "needs ";
  const std::string_view detail(fault.detail);
  return detail.size() == begin.size() + 1 && detail.starts_with(begin) ? detail.back() : '\0';
}

/// The digits of #101 behind its sign; empty where the number is computed.
std::string_view digits_of(std::string_view word) {
  const std::size_t sign = word.find('#');
  if (sign == std::string_view::npos) return {};
  const std::string_view behind = word.substr(sign + 1);
  constexpr std::size_t most = 12;
  return behind.substr(0, std::min(behind.find_first_not_of("0123456789"), most));
}

struct Computed {
  std::string_view digits;  ///< of its variable; empty: it is an expression
  Value value;
};

/// The word at `offset`, whose first byte is its letter; nothing where its number is written.
std::optional<Computed> read_word(std::string_view line, std::size_t offset, const Variables& variables) {
  if (offset >= line.size() || letter(line[offset]) == '\0') return std::nullopt;
  Scanner scanner(line, offset + 1);
  scanner.skip_blanks();
  if (scanner.peek(0) == '-' || scanner.peek(0) == '+') scanner.advance();
  scanner.skip_blanks();
  const char first = scanner.peek(0);
  if (first != '#' && first != '[') return std::nullopt;
  Computed word;
  if (first == '#') word.digits = digits_of(scanner.rest());
  Scanner operand(line, offset + 1);
  if (ExpressionReader(operand, variables).operand(word.value)) return std::nullopt;
  return word;
}

/// `name` with a variable that is vacant behind it.
std::optional<Computed> find_vacant(std::string_view line, char name, const Variables& variables) {
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (letter(line[at]) != name) continue;
    const auto word = read_word(line, at, variables);
    if (word && !word->digits.empty() && !word->value.given) return word;
  }
  return std::nullopt;
}

}  // namespace

std::string_view computed_word(const Fault& fault, std::string_view line, const Variables& variables,
                               WordDetail& detail) {
  detail[0] = '\0';
  if (const char name = missing_word(fault); name != '\0') {
    if (const auto vacant = find_vacant(line, name, variables))
      std::snprintf(detail.data(), detail.size(), "needs %c: #%.*s is vacant", name,
                    static_cast<int>(vacant->digits.size()), vacant->digits.data());
  } else if (is_of_value(fault.number) && fault.detail == nullptr) {
    const auto word = read_word(line, fault.offset, variables);
    if (!word) return {};
    if (word->digits.empty())
      std::snprintf(detail.data(), detail.size(), "the value is %.9g", word->value.number);
    else
      std::snprintf(detail.data(), detail.size(), "#%.*s is %.9g", static_cast<int>(word->digits.size()),
                    word->digits.data(), word->value.number);
  }
  return detail.data();
}

}  // namespace trunnion::language
