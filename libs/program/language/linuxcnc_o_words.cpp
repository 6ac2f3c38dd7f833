// SPDX-License-Identifier: Apache-2.0
// O words: subroutines, branches and loops.
#include <algorithm>
#include <cmath>

#include "language/linuxcnc_reader.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint8_t most_arguments = 30;
constexpr double most_repetitions = 999999999;

}  // namespace

Fault LinuxcncReader::o_word(std::uint16_t at) {
  scanner_.advance();
  OName name;
  bool computed = false;
  if (const Fault fault = o_name(at, name, computed)) return fault;
  block_.at = at;
  block_.statement = take_o_statement(scanner_);
  if (block_.statement == Statement::none) {
    if (computed || !ends_o_word(scanner_)) return {AlarmNumber::linuxcnc_o_word, at};
    block_.head = Head::program;
    block_.program_number = name.number;
    return {};
  }
  // What a search looks for is read in the text, so it cannot be computed.
  if (computed && block_.statement != Statement::call_sub)
    return {AlarmNumber::linuxcnc_o_word, at, "only a call may compute its number"};
  block_.name = name.key;
  block_.rest = scanner_.offset();
  if (block_.statement == Statement::else_if) return {};
  if (const Fault fault = o_operands(at)) return fault;
  return end_of_o_word(scanner_);
}

Fault LinuxcncReader::o_name(std::uint16_t at, OName& name, bool& computed) {
  computed = scanner_.peek() == '#' || scanner_.peek() == '[' ||
             (scanner_.peek_letter() != '\0' && scanner_.peek() != '<');
  if (!computed) {
    const auto read = read_o_name(scanner_);
    if (!read) return {AlarmNumber::linuxcnc_o_word, at};
    name = *read;
    return {};
  }
  if (const Fault fault = expressions_.whole(at, highest_o_number, name.number)) return fault;
  name.key = number_key(name.number);
  return {};
}

Fault LinuxcncReader::o_operands(std::uint16_t at) {
  double value = 0;
  switch (block_.statement) {
    case Statement::begin_if:
    case Statement::begin_while:
      if (const Fault fault = expressions_.expression(value)) return fault;
      block_.condition = value != 0;
      return {};
    case Statement::begin_repeat:
      return repetitions(at);
    case Statement::end_sub:
    case Statement::return_sub:
      if (scanner_.peek() != '[') return {};
      if (const Fault fault = expressions_.expression(value)) return fault;
      block_.arguments[block_.argument_count++] = Value::of(value);
      return {};
    case Statement::call_sub:
      return arguments();
    default:
      return {};
  }
}

Fault LinuxcncReader::repetitions(std::uint16_t at) {
  double value = 0;
  if (const Fault fault = expressions_.expression(value)) return fault;
  if (!(value < most_repetitions)) return {AlarmNumber::value_range, at};
  block_.arguments[block_.argument_count++] = Value::of(std::max(std::round(value), 0.0));
  return {};
}

Fault LinuxcncReader::arguments() {
  std::string_view comment;
  for (;;) {
    const std::uint16_t at = scanner_.offset();
    if (scanner_.peek() == '(') {
      if (!scanner_.take_comment(comment)) return {AlarmNumber::open_comment, at};
      continue;
    }
    if (scanner_.peek() != '[') return {};
    if (block_.argument_count == most_arguments) return {AlarmNumber::too_many_arguments, at};
    double value = 0;
    if (const Fault fault = expressions_.expression(value)) return fault;
    block_.arguments[block_.argument_count++] = Value::of(value);
  }
}

}  // namespace trunnion::language
