// SPDX-License-Identifier: Apache-2.0
#include "language/iso_cycle.hpp"

#include <cmath>
#include <cstddef>

#include "language/cycle_signature.hpp"
#include "language/expression.hpp"
#include "language/iso_line.hpp"

namespace trunnion::language {
namespace {

/// Vacant when the text is no number.
Value number_in(std::string_view text) {
  const Decimal decimal = read_decimal(text.data(), text.data() + text.size());
  const bool whole = decimal.status == DecimalStatus::ok && decimal.end == text.data() + text.size();
  return whole ? Value::of(decimal.value) : Value();
}

class CycleReader {
 public:
  CycleReader(Scanner& scanner, std::string_view line, const Variables& variables, Block& block)
      : scanner_(scanner), line_(line), variables_(variables), block_(block) {}

  Fault read() {
    scanner_.take_word("CYCLE");
    if (scanner_.at_end() || !is_digit(scanner_.peek())) return {AlarmNumber::unknown_instruction, block_.at};
    const Decimal name = scanner_.number();
    if (name.status != DecimalStatus::ok || name.value > highest_label || name.value < 1 ||
        name.value != std::floor(name.value))
      return {AlarmNumber::number_range, block_.at};
    const auto called = static_cast<std::uint32_t>(name.value);
    if (const char* const instead = instead_of_cycle(called))
      return {AlarmNumber::cycle_foreign, block_.at, instead};
    block_.program_number = cycle_program(called);
    // CYCLE800 needs no brackets to take the plane back.
    const bool bare = called == swivel_cycle && (!scanner_.more() || scanner_.peek() == ';');
    if (!bare) {
      if (const Fault fault = arguments(cycle_arguments(called))) return fault;
    }
    block_.statement = Statement::call_cycle;
    return end_of_line(scanner_);
  }

 private:
  Fault arguments(std::string_view kinds) {
    if (!scanner_.take('(')) return {AlarmNumber::operand_missing, scanner_.offset()};
    if (scanner_.take(')')) return {};
    for (;;) {
      if (const Fault fault = argument(kinds)) return fault;
      if (scanner_.take(')')) return {};
      if (!scanner_.take(',')) return {AlarmNumber::bracket_open, scanner_.offset()};
    }
  }

  /// The next one, before its comma.
  Fault argument(std::string_view kinds) {
    const bool more = scanner_.more();
    const std::uint16_t at = scanner_.offset();
    const char c = more ? scanner_.peek() : '\0';
    if (block_.argument_count == kinds.size()) return {AlarmNumber::too_many_arguments, at};
    Value& value = block_.arguments[block_.argument_count];
    const char kind = kinds[block_.argument_count];
    const bool text = kind != 'n';
    value = Value();
    ++block_.argument_count;
    if (c == ',' || c == ')') return {};
    if ((c == '"') != text && more) return {AlarmNumber::argument_kind, at};
    if (!text) return ExpressionReader(scanner_, variables_).expression(value);
    if (!more) return {AlarmNumber::bracket_open, at};
    do scanner_.advance();
    while (!scanner_.at_end() && scanner_.peek() != '"');
    if (scanner_.at_end()) return {AlarmNumber::bracket_open, at};
    const std::size_t first = at + std::size_t{1};
    if (kind == 's') value = number_in(line_.substr(first, scanner_.offset() - first));
    scanner_.advance();
    return {};
  }

  Scanner& scanner_;
  std::string_view line_;
  const Variables& variables_;
  Block& block_;
};

}  // namespace

Fault read_cycle(Scanner& scanner, std::string_view line, const Variables& variables, Block& block) {
  return CycleReader(scanner, line, variables, block).read();
}

}  // namespace trunnion::language
