// SPDX-License-Identifier: Apache-2.0
#include "language/num_expression.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "language/arithmetic.hpp"
#include "language/num_codes.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t last_local_l = 19, first_common_l = 100, last_common_l = 199;
constexpr std::uint32_t drive_sets = 353, drive_measurements = 942;  // hundreds of E353aa and E942xx

struct Comparison {
  std::string_view sign;
  Operator operation;
};

// A longer sign comes before a shorter one that begins it.
constexpr std::array comparisons = {
    Comparison{"<>", Operator::not_equal},     Comparison{"<=", Operator::less_equal},
    Comparison{">=", Operator::greater_equal}, Comparison{"=", Operator::equal},
    Comparison{"<", Operator::less},           Comparison{">", Operator::greater},
};

std::optional<Operator> calculation(char sign) {
  switch (sign) {
    case '+':
      return Operator::add;
    case '-':
      return Operator::subtract;
    case '*':
      return Operator::multiply;
    case '/':
      return Operator::divide;
    default:
      return std::nullopt;
  }
}

}  // namespace

Fault NumExpressionReader::value(double& result) {
  bool negative = false;
  if (scanner_.more() && (scanner_.peek() == '-' || scanner_.peek() == '+')) {
    negative = scanner_.peek() == '-';
    scanner_.advance();
  }
  if (const Fault fault = unsigned_value(result)) return fault;
  if (negative) result = 0 - result;
  return {};
}

Fault NumExpressionReader::expression(double& result) {
  if (const Fault fault = value(result)) return fault;
  bool summed = false;
  while (scanner_.more()) {
    const auto operation = calculation(scanner_.peek());
    if (!operation) break;
    const std::uint16_t at = scanner_.offset();
    const bool sum = *operation == Operator::add || *operation == Operator::subtract;
    if (!sum && summed) return {AlarmNumber::num_operation_order, at};
    summed = summed || sum;
    scanner_.advance();
    double right = 0;
    if (const Fault fault = value(right)) return fault;
    double both = 0;
    if (const AlarmNumber alarm = apply(*operation, Value::of(result), Value::of(right), both);
        alarm != AlarmNumber::none)
      return {alarm, at};
    result = both;
  }
  return {};
}

Fault NumExpressionReader::condition(bool& result) {
  double left = 0;
  if (const Fault fault = expression(left)) return fault;
  scanner_.skip_blanks();
  for (const Comparison& comparison : comparisons) {
    bool fits = true;
    for (std::size_t i = 0; i < comparison.sign.size(); ++i)
      fits = fits && scanner_.peek(i) == comparison.sign[i];
    if (!fits) continue;
    scanner_.advance(comparison.sign.size());
    double right = 0;
    if (const Fault fault = expression(right)) return fault;
    double holds = 0;
    const AlarmNumber alarm = apply(comparison.operation, Value::of(left), Value::of(right), holds);
    if (alarm != AlarmNumber::none) return {alarm, scanner_.offset()};
    result = holds != 0;
    return {};
  }
  return {AlarmNumber::operand_missing, scanner_.offset(), "needs = <> < > <= or >="};
}

Fault NumExpressionReader::variable(std::uint16_t at, std::uint32_t& number) {
  if (!digits(number)) return {AlarmNumber::number_missing, at};
  const bool there = number <= last_local_l || (number >= first_common_l && number <= last_common_l);
  return there ? Fault{} : Fault{AlarmNumber::variable_unknown, at, "L0 to L19 and L100 to L199"};
}

Fault NumExpressionReader::parameter(std::uint16_t at, ExternalPlace& place) {
  std::optional<ExternalPlace> found;
  std::uint32_t number = 0;
  if (scanner_.peek(0) == '[') {
    scanner_.advance();
    std::array<char, 8> name{};
    std::size_t size = 0;
    for (char c = scanner_.peek(0); c != ']'; c = scanner_.peek(0)) {
      if (scanner_.at_end()) return {AlarmNumber::bracket_open, at};
      if (size == name.size()) return {AlarmNumber::num_parameter_unknown, at};
      name[size++] = letter(c) != '\0' ? letter(c) : c;
      scanner_.advance();
    }
    scanner_.advance();
    found = external_parameter(std::string_view(name.data(), size));
  } else {
    if (!digits(number)) return {AlarmNumber::number_missing, at};
    found = external_parameter(number);
  }
  const bool of_drive = number / 100 == drive_sets || number / 100 == drive_measurements;
  if (!found) return {AlarmNumber::num_parameter_unknown, at, of_drive ? "NUM error 92" : nullptr};
  place = *found;
  return {};
}

Fault NumExpressionReader::unsigned_value(double& result) {
  if (!scanner_.more()) return {AlarmNumber::operand_missing, scanner_.offset()};
  const std::uint16_t at = scanner_.offset();
  const char c = scanner_.peek();
  if (c == '[') return modal_value(at, result);
  if (letter(c) == 'E') return parameter_value(at, result);
  if (letter(c) == 'L') {
    scanner_.advance();
    std::uint32_t number = 0;
    if (const Fault fault = variable(at, number)) return fault;
    Value stored;
    const AlarmNumber alarm = variables_.read(number, stored);
    result = stored.number;
    return alarm == AlarmNumber::none ? Fault{} : Fault{alarm, at};
  }
  if (!is_digit(c) && c != '.') return {AlarmNumber::operand_missing, at};
  const Decimal decimal = scanner_.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::operand_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  result = decimal.value;
  return {};
}

Fault NumExpressionReader::parameter_value(std::uint16_t at, double& result) {
  scanner_.advance();
  ExternalPlace place;
  if (const Fault fault = parameter(at, place)) return fault;
  if (place.is_free()) {
    Value stored;
    const AlarmNumber alarm = variables_.read(first_free_variable + place.index, stored);
    result = stored.number;
    return alarm == AlarmNumber::none ? Fault{} : Fault{alarm, at};
  }
  const AlarmNumber alarm = variables_.read_external(place.number(), result);
  return alarm == AlarmNumber::none ? Fault{} : Fault{alarm, at, place.name()};
}

Fault NumExpressionReader::modal_value(std::uint16_t at, double& result) {
  scanner_.advance();
  std::uint32_t number = 0;
  const bool named =
      scanner_.peek(0) == '.' && letter(scanner_.peek(1)) == 'R' && letter(scanner_.peek(2)) == 'G';
  if (!named) return {AlarmNumber::num_modal_read, at};
  scanner_.advance(3);
  if (!digits(number)) return {AlarmNumber::num_modal_read, at};
  if (scanner_.peek(0) != ']') return {AlarmNumber::bracket_open, at};
  scanner_.advance();
  const NumCode* const code = num_code(number, false);
  if (code == nullptr || code->modal == 0) return {AlarmNumber::num_modal_read, at};
  Value active;
  const AlarmNumber alarm = variables_.read(code->modal, active);
  if (alarm != AlarmNumber::none) return {alarm, at};
  result = num_number(active.number);
  return {};
}

bool NumExpressionReader::digits(std::uint32_t& number) {
  number = 0;
  std::size_t count = 0;
  for (; is_digit(scanner_.peek(0)) && count < 8; ++count) {
    number = number * 10 + static_cast<std::uint32_t>(scanner_.peek(0) - '0');
    scanner_.advance();
  }
  return count != 0;
}

}  // namespace trunnion::language
