#include "language/alarms.hpp"

#include <algorithm>

namespace trunnion::language {
namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

bool is_number_character(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-'; }

/// The word at the start of `text`: a letter and its number, or one character.
std::string_view word_at(std::string_view text) {
  if (text.empty()) return text;
  std::size_t size = 1;
  while (size < text.size() && is_continuation(text[size])) ++size;
  if (size > 1) return text.substr(0, size);
  std::size_t end = size;
  while (end < text.size() && (text[end] == ' ' || text[end] == '\t')) ++end;
  if (end < text.size() && is_number_character(text[end])) {
    while (end < text.size() && is_number_character(text[end])) ++end;
    size = end;
  }
  return text.substr(0, std::min<std::size_t>(size, 32));
}

}  // namespace

Alarm make_alarm(const Fault& fault, std::string_view line_text, std::uint32_t program, std::uint32_t line) {
  Alarm alarm;
  alarm.number = fault.number;
  alarm.program = program;
  alarm.line = line;
  const std::size_t offset = std::min<std::size_t>(fault.offset, line_text.size());
  const auto before = line_text.substr(0, offset);
  const auto continuations = std::count_if(before.begin(), before.end(), is_continuation);
  alarm.column = static_cast<std::uint32_t>(before.size() - static_cast<std::size_t>(continuations) + 1);

  char* out = alarm.text.data();
  const auto append = [&](std::string_view part) { out = std::copy(part.begin(), part.end(), out); };
  append(alarm_text(fault.number));
  // Bytes that are no UTF-8 or no printable character must not reach a display.
  const bool printable = fault.number != AlarmNumber::not_utf8 && fault.number != AlarmNumber::line_too_long;
  const auto word = printable ? word_at(line_text.substr(offset)) : std::string_view{};
  if (!word.empty()) {
    append(": ");
    for (const char c : word) *out++ = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  *out = '\0';
  return alarm;
}

}  // namespace trunnion::language
