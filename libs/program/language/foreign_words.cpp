// SPDX-License-Identifier: Apache-2.0
#include "language/foreign_words.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "language/foreign_word_table.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {
namespace {

constexpr std::string_view blanks = " \t";

constexpr bool is_name(char c) { return c == '@' || letter(c) != '\0'; }
constexpr bool is_figure(char c) { return c == '#' || c == '?' || is_digit(c); }

/// Takes what `c` of a pattern is for.
bool take(char c, Scanner& text) {
  const char next = text.peek(0);
  bool good = next == c;
  if (c == '#' || c == '?') good = is_digit(next);
  if (c == '@') good = letter(next) != '\0';
  if (letter(c) != '\0') good = letter(next) == c;
  if (!good) return false;
  text.advance();
  while (c == '#' && is_digit(text.peek(0))) text.advance();
  return true;
}

bool fits(std::string_view pattern, Scanner text) {
  char before = '\0';
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char c = pattern[i];
    if (c == ' ') {
      const bool apart = is_blank(text.peek(0));
      text.skip_blanks();
      // Without a blank the two words would be one.
      if (!apart && is_name(before) && is_name(pattern[i + 1])) return false;
      continue;
    }
    if (is_figure(c) && is_name(before)) {
      text.skip_blanks();
      while (text.peek(0) == '0' && is_digit(text.peek(1))) text.advance();
    }
    if (!take(c, text)) return false;
    before = c;
  }
  const char next = text.peek(0);
  if (is_name(before)) return letter(next) == '\0';
  return !is_figure(before) || (!is_digit(next) && next != '.');
}

bool has_word(std::string_view pattern, std::string_view line) {
  for (std::size_t at = 0; at < line.size(); ++at) {
    const bool begins = at == 0 || letter(line[at - 1]) == '\0';
    if (begins && fits(pattern, Scanner(line, at))) return true;
  }
  return false;
}

/// The word begins before the sign of equality that a reader fails at, in the middle of the letters of a name
/// (GOTOF), or behind the number of a conversational block.
std::size_t word_begin(std::string_view line, std::size_t at) {
  if (at >= line.size()) return line.size();
  const auto back = [&](auto&& belongs) {
    while (at > 0 && belongs(line[at - 1])) --at;
  };
  const auto is_letter = [](char c) { return letter(c) != '\0'; };
  if (line[at] == '=') {
    back(is_blank);
    back(is_digit);
    back(is_letter);
  } else if (is_letter(line[at])) {
    back(is_letter);
  } else if (is_digit(line[at]) && line.find_first_not_of(blanks) == at) {
    at = std::min(line.find_first_not_of("0123456789", at), line.size());
    at = std::min(line.find_first_not_of(blanks, at), line.size());
  }
  return at;
}

bool begins_block(std::string_view line, std::size_t at) {
  return line.substr(0, at).find_first_not_of(" \tNn/0123456789") == std::string_view::npos;
}

/// A fault of this kind may be due to a word that another control has.
bool may_be_foreign(AlarmNumber number) {
  switch (number) {
    case AlarmNumber::unknown_character:
    case AlarmNumber::number_missing:
    case AlarmNumber::not_an_integer:
    case AlarmNumber::unknown_instruction:
    case AlarmNumber::statement_not_first:
    case AlarmNumber::text_behind_statement:
    case AlarmNumber::operand_missing:
    case AlarmNumber::unknown_g:
    case AlarmNumber::unknown_m:
    case AlarmNumber::unused_word:
    case AlarmNumber::missing_word:
    case AlarmNumber::pattern_without_cycle:
      return true;
    default:
      return false;
  }
}

/// What is wrong may have another cause than the word: then only rows count that leave no doubt.
bool is_due(const ForeignWord& row, const Fault& fault, std::string_view line) {
  const char first = row.word.front();
  const bool needs_more = !row.with.empty() && row.with.front() != '-';
  if (fault.number == AlarmNumber::operand_missing && letter(first) == '\0' && first != '$') return false;
  if (fault.number == AlarmNumber::unused_word || fault.number == AlarmNumber::missing_word)
    if (!needs_more) return false;
  if (fault.offset < line.size() && line[fault.offset] == '=' && row.word.find('=') == std::string_view::npos)
    return false;
  if (row.with.empty()) return true;
  return needs_more ? has_word(row.with, line) : !has_word(row.with.substr(1), line);
}

}  // namespace

constinit const std::span<const ForeignWord> foreign_words = foreign_word_table;

const ForeignWord* find_foreign_word(const Fault& fault, std::string_view line, std::uint16_t& at) {
  if (!may_be_foreign(fault.number)) return nullptr;
  const std::size_t from = word_begin(line, fault.offset);
  for (const ForeignWord& row : foreign_words) {
    const bool first = row.word.front() == '^';
    if (first && !begins_block(line, from)) continue;
    if (!fits(row.word.substr(first ? 1u : 0u), Scanner(line, from)) || !is_due(row, fault, line)) continue;
    at = static_cast<std::uint16_t>(from);
    return &row;
  }
  return nullptr;
}

const ForeignWord* foreign_m(std::uint32_t number) {
  for (const ForeignWord& row : foreign_words) {
    if (row.word.front() != 'M') continue;
    std::uint32_t code = 0;
    const char* const end = row.word.data() + row.word.size();
    const auto read = std::from_chars(row.word.data() + 1, end, code);
    if (read.ec == std::errc{} && read.ptr == end && code == number) return &row;
  }
  return nullptr;
}

}  // namespace trunnion::language
