// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_reader.hpp"

#include <cmath>

#include "language/decimal.hpp"
#include "language/linuxcnc_codes.hpp"
#include "text/utf8.hpp"

namespace trunnion::language {

Fault LinuxcncReader::read() {
  block_.clear();
  block_.table = CodeTable::linuxcnc;
  if (scanner_.take('/') && (skip_ & 1u) != 0) {
    block_.skipped = true;
    return {};
  }
  if (scanner_.peek() == '%') {
    block_.head = Head::tape_mark;
    scanner_.advance();
    return scanner_.at_end() ? Fault{} : Fault{AlarmNumber::text_behind_statement, scanner_.offset()};
  }
  if (scanner_.peek_letter() == 'N') {
    const std::uint16_t at = scanner_.offset();
    scanner_.advance();
    double number = 0;
    if (const Fault fault = read_line_number(scanner_, at, number)) return fault;
    store('N', number, at);
  }
  if (scanner_.peek_letter() == 'O') return o_word(scanner_.offset());
  while (!done_ && !scanner_.at_end()) {
    if (const Fault fault = item()) return fault;
  }
  return complete();
}

Fault LinuxcncReader::item() {
  const std::uint16_t at = scanner_.offset();
  const char c = scanner_.peek();
  const char name = scanner_.peek_letter();
  if (name != '\0') return word(name, at);
  switch (c) {
    case '#':
      return setting(at);
    case '(':
      comment_at_ = at;
      return scanner_.take_comment(comment_) ? Fault{} : Fault{AlarmNumber::open_comment, at};
    case ';':
      comment_at_ = at;
      comment_ = line_.substr(std::size_t{at} + 1);
      done_ = true;
      return {};
    case '$':
      return spindle_number(at);
    case '@':
    case '^':
      return {AlarmNumber::linuxcnc_function_missing, at, "polar coordinates"};
    case '/':
    case '%':
      return {AlarmNumber::misplaced_head, at};
    default:
      break;
  }
  const bool broken = text::valid_utf8_prefix(line_.substr(at, 4)) == 0;
  return {broken ? AlarmNumber::not_utf8 : AlarmNumber::unknown_character, at};
}

Fault LinuxcncReader::setting(std::uint16_t at) {
  scanner_.advance();
  if (setting_count_ == settings_.size()) return {AlarmNumber::too_many_codes, at};
  Setting& setting = settings_[setting_count_];
  if (const Fault fault = expressions_.parameter(at, setting.parameter)) return fault;
  if (!scanner_.take('=')) return {AlarmNumber::operand_missing, scanner_.offset(), "needs ="};
  if (const Fault fault = expressions_.value(setting.value)) return fault;
  ++setting_count_;
  return {};
}

Fault LinuxcncReader::word(char name, std::uint16_t at) {
  if (name == 'O') return {AlarmNumber::statement_not_first, at};
  if (name == 'N') return {AlarmNumber::misplaced_head, at};
  scanner_.advance();
  if (scanner_.at_end()) return {AlarmNumber::number_missing, at};
  double value = 0;
  if (const Fault fault = expressions_.value(value)) return fault;
  if (std::abs(value) > largest_number) return {AlarmNumber::number_range, at};
  if (name == 'G') return g_word(value, at);
  if (name == 'M') return m_word(value, at);
  if (block_.has(name)) return {AlarmNumber::letter_twice, at};
  constexpr std::uint32_t whole_letters = letter_bits("DHLT");
  const double whole = std::round(value);
  const bool counts = (whole_letters & Block::bit(name)) != 0 && std::abs(value - whole) < whole_enough;
  store(name, counts ? whole : value, at);
  return {};
}

Fault LinuxcncReader::g_word(double value, std::uint16_t at) {
  if (block_.g_count == max_g_codes) return {AlarmNumber::too_many_codes, at};
  const double tenths = std::round(value * 10);
  if (std::abs(value * 10 - tenths) > whole_enough || !(tenths >= 0 && tenths < 1000))
    return {AlarmNumber::linuxcnc_g_unknown, at};
  const auto number = static_cast<std::uint32_t>(tenths);
  if (const char* const missing = linuxcnc_missing_g(number))
    return {AlarmNumber::linuxcnc_function_missing, at, missing};
  if (linuxcnc_g_code(number) == nullptr) return {AlarmNumber::linuxcnc_g_unknown, at};
  block_.g[block_.g_count++] = {tenths / 10, at};
  return {};
}

Fault LinuxcncReader::m_word(double value, std::uint16_t at) {
  if (block_.m_count == max_m_codes) return {AlarmNumber::too_many_codes, at};
  const double whole = std::round(value);
  if (std::abs(value - whole) > whole_enough || !(whole >= 0 && whole <= highest_m))
    return {AlarmNumber::linuxcnc_m_unknown, at};
  if (const char* const missing = linuxcnc_missing_m(static_cast<std::uint32_t>(whole)))
    return {AlarmNumber::linuxcnc_function_missing, at, missing};
  block_.m[block_.m_count++] = {whole, at};
  return {};
}

// The dialect has one spindle, which is spindle 0 of LinuxCNC.
Fault LinuxcncReader::spindle_number(std::uint16_t at) {
  scanner_.advance();
  double value = 0;
  if (const Fault fault = expressions_.value(value)) return fault;
  return value == 0 ? Fault{} : Fault{AlarmNumber::linuxcnc_function_missing, at, "spindles other than $0"};
}

void LinuxcncReader::store(char name, double value, std::uint16_t at) {
  const auto index = static_cast<std::size_t>(name - 'A');
  block_.letters |= Block::bit(name);
  block_.values[index] = value;
  block_.offsets[index] = at;
}

}  // namespace trunnion::language
