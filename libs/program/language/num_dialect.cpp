// SPDX-License-Identifier: Apache-2.0
#include "language/num_dialect.hpp"

#include "language/macro_call.hpp"
#include "language/num_line.hpp"
#include "language/num_reader.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t homing_program = 9990 + 9 * program_tenth;

}  // namespace

DialectRules NumDialect::rules() const { return {true, false, homing_program, true}; }

Fault NumDialect::read_block(std::string_view line, SkipLevels skip, Variables& variables,
                             Block& block) const {
  return NumReader(line, skip, variables, block).read();
}

Fault NumDialect::read_condition(std::string_view, std::uint16_t, const Variables&, bool& condition) const {
  condition = false;
  return {};
}

Outline NumDialect::outline(std::string_view line, SkipLevels skip) const {
  Outline outline;
  Scanner scanner(line);
  if (scanner.more() && scanner.peek() == '/') {
    if ((skip & 1u) != 0) return outline;
    scanner.advance();
  }
  if (scanner.more() && scanner.peek() == '%') {
    if (read_num_head(scanner, outline.program_number)) return outline;
    outline.head = Head::program;
  }
  if (!skip_remarks(scanner) || scanner.at_end()) return outline;
  if (letter(scanner.peek()) == 'N') {
    const std::uint16_t at = scanner.offset();
    scanner.advance();
    std::uint32_t number = 0;
    if (read_sequence_number(scanner, at, number)) return outline;
    outline.sequence_number = number;
    if (!skip_remarks(scanner) || scanner.at_end()) return outline;
  }
  if (outline.head == Head::none) outline.statement = take_structure(scanner);
  const bool passed = outline.statement == Statement::else_ || outline.statement == Statement::end_if ||
                      outline.statement == Statement::end_while;
  if (passed) outline.behind = end_of_num_line(scanner);
  return outline;
}

}  // namespace trunnion::language
