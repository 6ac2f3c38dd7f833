// SPDX-License-Identifier: Apache-2.0
#include "language/num_reader.hpp"

#include <array>
#include <cmath>

#include "canonical/spindle_value.hpp"
#include "language/arithmetic.hpp"
#include "language/num_line.hpp"
#include "text/utf8.hpp"

namespace trunnion::language {
namespace {

constexpr double largest_parameter = 2147483647;
constexpr double tap_removal = 84.9;  // of g_codes
constexpr std::uint32_t num_letters = letter_bits("ABCFHKRSTUVWXYZ");

/// E and a letter: words of G84, and of functions that are not there.
struct PairWord {
  char second;
  char word;             ///< of the block; zero when the function is not there
  const char* function;  ///< that is not there
};
constexpr std::array pair_words = {
    PairWord{'A', '\0', thread_cycle},     PairWord{'B', '\0', thread_cycle},
    PairWord{'S', '\0', thread_cycle},     PairWord{'H', work_plane_word, ""},
    PairWord{'K', retract_ratio_word, ""}, PairWord{'R', approach_word, ""},
};

}  // namespace

Fault NumReader::read() {
  block_.clear();
  if (scanner_.more() && scanner_.peek() == '/') {
    scanner_.advance();
    block_.skipped = (skip_ & 1u) != 0;
    if (block_.skipped) return {};
  }
  if (scanner_.more() && scanner_.peek() == '%') {
    if (const Fault fault = read_num_head(scanner_, block_.program_number)) return fault;
    block_.head = Head::program;
  }
  while (!done_ && scanner_.more()) {
    if (const Fault fault = item()) return fault;
  }
  return complete();
}

Fault NumReader::item() {
  const char c = scanner_.peek();
  const char upper = letter(c);
  const std::uint16_t at = scanner_.offset();
  if (upper != '\0') {
    const Statement statement = take_structure(scanner_);
    if (statement != Statement::none) return structure(statement, at);
    if (upper == 'E') return e_item(at);
    if (upper == 'L') return assign_variable(at);
    const char second = letter(scanner_.peek(1));
    if (second != '\0' && second != 'E' && second != 'L' && !homes(upper))
      return {AlarmNumber::unknown_instruction, at};
    return word(upper, at);
  }
  if (c == '(') return scanner_.skip_comment() ? Fault{} : Fault{AlarmNumber::open_comment, at};
  if (c == '$') {
    scanner_.advance();
    block_.message = scanner_.more();
    block_.message_at = scanner_.offset();
    done_ = true;
    return {};
  }
  if (c == '%' || c == '/') return {AlarmNumber::misplaced_head, at};
  const bool broken = text::valid_utf8_prefix(line_.substr(at, 4)) == 0;
  return {broken ? AlarmNumber::not_utf8 : AlarmNumber::unknown_character, at};
}

Fault NumReader::structure(Statement statement, std::uint16_t at) {
  if (any_ || block_.head != Head::none) return {AlarmNumber::statement_not_first, at};
  any_ = true;
  block_.statement = statement;
  block_.at = at;
  const bool branch = statement == Statement::begin_if;
  if (!branch && statement != Statement::begin_while) return end_of_block();
  if (const Fault fault = expressions_.condition(block_.condition)) return fault;
  if (!scanner_.more() || !scanner_.take_word(branch ? "THEN" : "DO"))
    return {AlarmNumber::operand_missing, scanner_.offset(), branch ? "needs THEN" : "needs DO"};
  // What follows counts only when the condition holds.
  done_ = !block_.condition;
  return {};
}

Fault NumReader::end_of_block() {
  done_ = true;
  return end_of_num_line(scanner_);
}

Fault NumReader::e_item(std::uint16_t at) {
  const char second = letter(scanner_.peek(1));
  if (second == '\0') return assign_parameter(at);
  if (second == 'C') return takes_up() ? taught_word(taught_angle_word, at) : spindle_angle(at);
  if (second == 'X') return taught_word(taught_x_word, at);
  if (second == 'Z') return taught_word(taught_z_word, at);
  for (const PairWord& pair : pair_words) {
    if (pair.second != second) continue;
    scanner_.advance(2);
    double value = 0;
    if (const Fault fault = number(at, value)) return fault;
    if (pair.word == '\0') return {AlarmNumber::num_function_missing, at, pair.function};
    any_ = true;
    if (block_.has(pair.word)) return {AlarmNumber::letter_twice, at};
    store(pair.word, value, at);
    return {};
  }
  return {AlarmNumber::unknown_instruction, at};
}

Fault NumReader::taught_word(char name, std::uint16_t at) {
  scanner_.advance(2);
  double value = 0;
  if (const Fault fault = number(at, value)) return fault;
  any_ = true;
  if (thread_ != NumUse::one_pass && name != taught_angle_word) return {AlarmNumber::num_word, at};
  if (block_.has(name)) return {AlarmNumber::letter_twice, at};
  store(name, value, at);
  return {};
}

Fault NumReader::spindle_angle(std::uint16_t at) {
  scanner_.advance(2);
  double value = 0;
  if (const Fault fault = number(at, value)) return fault;
  any_ = assigned_ = true;
  orders_angle_ = true;
  angle_at_ = at;
  return order(canonical::order_angle, value, at);
}

Fault NumReader::order(std::uint32_t number, double value, std::uint16_t at) {
  if (!orders_) order_at_ = at;
  orders_ = true;
  Fault fault = variables_.write_external(number, value);
  fault.offset = at;
  return fault;
}

Fault NumReader::assigned(double& value) {
  any_ = assigned_ = true;
  if (!scanner_.take('=')) return {AlarmNumber::operand_missing, scanner_.offset(), "needs ="};
  return expressions_.expression(value);
}

Fault NumReader::assign_variable(std::uint16_t at) {
  scanner_.advance();
  std::uint32_t number = 0;
  double value = 0;
  if (const Fault fault = expressions_.variable(at, number)) return fault;
  if (const Fault fault = assigned(value)) return fault;
  const AlarmNumber alarm = variables_.write(number, Value::of(value));
  return alarm == AlarmNumber::none ? Fault{} : Fault{alarm, at};
}

Fault NumReader::assign_parameter(std::uint16_t at) {
  scanner_.advance();
  ExternalPlace place;
  double value = 0;
  if (const Fault fault = expressions_.parameter(at, place)) return fault;
  if (!place.is_free() && !place.row->writable) return {AlarmNumber::variable_read_only, at, place.name()};
  if (const Fault fault = assigned(value)) return fault;
  value = nearly_whole(value);
  if (!place.is_free()) {
    Fault fault = order(place.number(), value, at);
    if (fault && fault.number != value_pending && fault.detail == nullptr &&
        fault.number != AlarmNumber::spindle_without_mark)
      fault.detail = place.name();
    return fault;
  }
  if (value != std::floor(value) || std::abs(value) > largest_parameter)
    return {AlarmNumber::variable_value, at, "a whole number"};
  const AlarmNumber alarm = variables_.write(first_free_variable + place.index, Value::of(value));
  return alarm == AlarmNumber::none ? Fault{} : Fault{alarm, at};
}

Fault NumReader::number(std::uint16_t at, double& value) {
  scanner_.skip_blanks();
  const char sign = scanner_.peek(0);
  const char first = letter(scanner_.peek(sign == '-' || sign == '+' ? 1 : 0));
  if (first == 'L' || first == 'E') {
    if (const Fault fault = expressions_.value(value)) return fault;
    value = nearly_whole(value);
    return std::abs(value) > largest_number ? Fault{AlarmNumber::number_range, at} : Fault{};
  }
  const Decimal decimal = scanner_.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  value = decimal.value;
  return {};
}

Fault NumReader::word(char name, std::uint16_t at) {
  scanner_.advance();
  if (name == 'G') return g_word(at);
  if (name == 'N') return sequence_number(at);
  if (thread_ == NumUse::one_pass && (name == 'P' || name == 'Q'))
    return {AlarmNumber::num_function_missing, at, thread_cycle};
  if (name != 'M' && (num_letters & Block::bit(name)) == 0) return {AlarmNumber::num_word, at};
  double value = 0;
  if (!names_axis(name)) {
    if (const Fault fault = number(at, value)) return fault;
  }
  any_ = true;
  if (name == 'M') {
    if (value == 30 || value == 98 || value == 99) return {AlarmNumber::num_m_unknown, at};
    return add_m(value, at);
  }
  if (block_.has(name)) return {AlarmNumber::letter_twice, at};
  store(name, value, at);
  return {};
}

bool NumReader::names_axis(char name) {
  if (!homes(name)) return false;
  if (!scanner_.more()) return true;
  const char next = scanner_.peek();
  return letter(next) != '\0' || next == '(' || next == '$';
}

Fault NumReader::sequence_number(std::uint16_t at) {
  if (any_ || block_.has('N')) return {AlarmNumber::num_word, at};
  std::uint32_t number = 0;
  if (const Fault fault = read_sequence_number(scanner_, at, number)) return fault;
  store('N', number, at);
  return {};
}

Fault NumReader::add_m(double value, std::uint16_t at) {
  if (block_.m_count == max_m_codes) return {AlarmNumber::too_many_codes, at};
  block_.m[block_.m_count++] = {value, at};
  return {};
}

void NumReader::store(char name, double value, std::uint16_t at) {
  const auto index = static_cast<std::size_t>(name - 'A');
  block_.letters |= Block::bit(name);
  block_.values[index] = value;
  block_.offsets[index] = at;
}

Fault NumReader::g_word(std::uint16_t at) {
  scanner_.skip_blanks();
  const Decimal decimal = scanner_.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  const bool plus = scanner_.peek(0) == '+';
  if (plus) scanner_.advance();
  const NumCode* const code = num_code(decimal.value, plus);
  if (code == nullptr) return {AlarmNumber::num_g_unknown, at};
  switch (code->use) {
    case NumUse::wait_mark:
      return {AlarmNumber::num_wait_mark, at};
    case NumUse::jump:
      return jump(at);
    case NumUse::call:
      any_ = true;
      if (calls_) return {AlarmNumber::group_twice, at};
      calls_ = true;
      call_at_ = at;
      return {};
    case NumUse::dwell:
      dwells_ = true;
      dwell_at_ = at;
      break;
    case NumUse::tap:
      taps_ = true;
      tap_at_ = at;
      break;
    case NumUse::removal:
      removes_ = true;
      removal_at_ = at;
      break;
    case NumUse::thread:
    case NumUse::resumed:
    case NumUse::one_pass:
      if (const Fault fault = thread(code->use, at)) return fault;
      break;
    case NumUse::home:
      homes_ = true;
      break;
    case NumUse::code:
      break;
  }
  any_ = true;
  if (block_.g_count == max_g_codes) return {AlarmNumber::too_many_codes, at};
  const double value = code->use == NumUse::removal ? tap_removal : code->code;
  block_.g[block_.g_count++] = {value, at};
  return {};
}

Fault NumReader::thread(NumUse use, std::uint16_t at) {
  if (thread_ != NumUse::code) return {AlarmNumber::group_twice, at};
  thread_ = use;
  thread_at_ = at;
  if (use != NumUse::resumed) return {};
  for (const bool distance : {true, false}) {
    if (!skip_remarks(scanner_)) return {AlarmNumber::open_comment, scanner_.offset()};
    const std::uint16_t word_at = scanner_.offset();
    if (!scanner_.take_word(distance ? "J" : "EC"))
      return {AlarmNumber::missing_word, at, "needs J and EC behind it"};
    double value = 0;
    if (const Fault fault = number(word_at, value)) return fault;
    store(distance ? 'J' : taught_angle_word, value, word_at);
  }
  return {};
}

Fault NumReader::jump(std::uint16_t at) {
  if (any_) return {AlarmNumber::statement_not_first, at};
  any_ = true;
  bool holds = true;
  if (scanner_.more() && letter(scanner_.peek()) != 'N') {
    if (const Fault fault = expressions_.condition(holds)) return fault;
  }
  if (!scanner_.more() || letter(scanner_.peek()) != 'N') return {AlarmNumber::missing_word, at, needs('N')};
  const std::uint16_t target = scanner_.offset();
  scanner_.advance();
  std::uint32_t label = 0;
  if (const Fault fault = read_sequence_number(scanner_, target, label)) return fault;
  if (const Fault fault = end_of_block()) return fault;
  if (!holds) return {};
  block_.statement = Statement::go_to;
  block_.label = label;
  block_.at = at;
  return {};
}

}  // namespace trunnion::language
