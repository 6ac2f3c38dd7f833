// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_dialect.hpp"

#include <cmath>

#include "language/linuxcnc_line.hpp"
#include "language/linuxcnc_reader.hpp"

namespace trunnion::language {

DialectRules LinuxcncDialect::rules() const {
  DialectRules rules;
  rules.cycle_m_codes = false;
  rules.heads_end_text = false;
  rules.number_counts = false;
  rules.returns_to_r = true;
  return rules;
}

Fault LinuxcncDialect::read_block(std::string_view line, SkipLevels skip, Variables& variables,
                                  Block& block) const {
  return LinuxcncReader(line, skip, variables, block).read();
}

Fault LinuxcncDialect::read_condition(std::string_view line, std::uint16_t rest, const Variables& variables,
                                      bool& condition) const {
  LinuxcncScanner scanner(line, rest);
  double value = 0;
  if (const Fault fault = LinuxcncExpression(scanner, variables).expression(value)) return fault;
  condition = value != 0;
  return end_of_o_word(scanner);
}

Outline LinuxcncDialect::outline(std::string_view line, SkipLevels skip) const {
  Outline outline;
  LinuxcncScanner scanner(line);
  if (scanner.take('/') && (skip & 1u) != 0) return outline;
  if (scanner.take('%')) {
    if (scanner.at_end()) outline.head = Head::tape_mark;
    return outline;
  }
  if (scanner.peek_letter() == 'N') {
    const std::uint16_t at = scanner.offset();
    scanner.advance();
    double number = 0;
    if (read_line_number(scanner, at, number)) return outline;
    if (number == std::floor(number)) outline.sequence_number = static_cast<std::uint32_t>(number);
  }
  if (scanner.peek_letter() != 'O') return outline;
  scanner.advance();
  const auto name = read_o_name(scanner);
  if (!name) return outline;
  outline.statement = take_o_statement(scanner);
  if (outline.statement == Statement::none) {
    if (!ends_o_word(scanner)) return outline;
    outline.head = Head::program;
    outline.program_number = name->number;
    return outline;
  }
  outline.name = name->key;
  const bool passed = outline.statement == Statement::else_ || outline.statement == Statement::end_if ||
                      outline.statement == Statement::end_while || outline.statement == Statement::end_repeat;
  if (passed) outline.behind = end_of_o_word(scanner);
  return outline;
}

}  // namespace trunnion::language
