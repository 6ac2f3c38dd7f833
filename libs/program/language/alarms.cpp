// SPDX-License-Identifier: Apache-2.0
#include "language/alarms.hpp"

#include <algorithm>
#include <array>

#include "text/utf8.hpp"

namespace trunnion::language {
namespace {

constexpr std::size_t longest_comment = 96;  // of #3000, bytes

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

bool is_number_character(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-'; }

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/// The word at the start of `text`: a name, a letter and its number, a variable, a number, or one character.
std::string_view word_at(std::string_view text) {
  if (text.empty()) return text;
  const auto run = [text](std::size_t from, auto&& belongs) {
    while (from < text.size() && belongs(text[from])) ++from;
    return from;
  };
  std::size_t size = 1;
  if (text[0] == ',' && text.size() > 1 && is_letter(text[1])) {
    size += word_at(text.substr(1)).size();
  } else if (is_letter(text[0])) {
    size = run(1, is_letter);
    if (size == 1) {
      const std::size_t blanks = run(1, [](char c) { return c == ' ' || c == '\t'; });
      const std::size_t end = run(blanks, is_number_character);
      if (end != blanks) size = end;
    }
  } else if (text[0] == '#' || is_number_character(text[0])) {
    size = run(1, is_number_character);
  } else {
    size = run(1, is_continuation);
  }
  return text.substr(0, std::min<std::size_t>(size, 32));
}

constexpr auto needed_words = [] {
  std::array<std::array<char, 8>, 26> texts{};
  for (std::size_t i = 0; i < texts.size(); ++i)
    texts[i] = {'n', 'e', 'e', 'd', 's', ' ', static_cast<char>('A' + i), '\0'};
  return texts;
}();

}  // namespace

const char* needs(char letter) { return needed_words[static_cast<std::size_t>(letter - 'A')].data(); }

Alarm make_alarm(const Fault& fault, std::string_view line_text, std::uint32_t program, std::uint32_t line,
                 std::string_view detail) {
  Alarm alarm;
  alarm.number = fault.number;
  alarm.program = program;
  alarm.line = line;
  const std::size_t offset = std::min<std::size_t>(fault.offset, line_text.size());
  alarm.column = static_cast<std::uint32_t>(text::character_count(line_text.substr(0, offset)) + 1);

  char* out = alarm.text.data();
  const auto append = [&](std::string_view part) { out = std::copy(part.begin(), part.end(), out); };
  append(alarm_text(fault.number));
  // Bytes that are no UTF-8 or no printable character must not reach a display.
  const bool printable = fault.number != AlarmNumber::not_utf8 && fault.number != AlarmNumber::line_too_long;
  const auto at_fault = line_text.substr(offset);
  if (fault.number == AlarmNumber::program_alarm) {
    append(": ");
    out += text::copy_readable(at_fault, {out, longest_comment});
  } else if (const auto word = printable ? word_at(at_fault) : std::string_view{}; !word.empty()) {
    append(": ");
    for (const char c : word) *out++ = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  if (fault.detail != nullptr) detail = fault.detail;
  if (!detail.empty()) {
    append(", ");
    append(detail.substr(0, 48));
  }
  *out = '\0';
  return alarm;
}

}  // namespace trunnion::language
