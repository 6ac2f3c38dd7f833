// SPDX-License-Identifier: Apache-2.0
#include "language/expression.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

namespace trunnion::language {
namespace {

struct OperatorSign {
  std::string_view sign;
  Operator operation;
  int binding;  // the higher, the sooner
};

constexpr int binds_least = 1;

// A longer sign comes before a shorter one that begins it.
constexpr std::array operator_words = {
    OperatorSign{"EQ", Operator::equal, 3},    OperatorSign{"NE", Operator::not_equal, 3},
    OperatorSign{"GT", Operator::greater, 3},  OperatorSign{"GE", Operator::greater_equal, 3},
    OperatorSign{"LT", Operator::less, 3},     OperatorSign{"LE", Operator::less_equal, 3},
    OperatorSign{"AND", Operator::bit_and, 5}, OperatorSign{"OR", Operator::bit_or, 4},
    OperatorSign{"XOR", Operator::bit_xor, 4}, OperatorSign{"MOD", Operator::modulo, 5},
};

std::optional<OperatorSign> next_operator(const Scanner& scanner) {
  const char second = scanner.peek(1);
  switch (scanner.peek()) {
    case '*':
      return OperatorSign{"*", Operator::multiply, 5};
    case '/':
      return OperatorSign{"/", Operator::divide, 5};
    case '+':
      return OperatorSign{"+", Operator::add, 4};
    case '-':
      return OperatorSign{"-", Operator::subtract, 4};
    case '=':
      if (second == '=') return OperatorSign{"==", Operator::equal, 3};
      return std::nullopt;
    case '!':
      if (second == '=') return OperatorSign{"!=", Operator::not_equal, 3};
      return std::nullopt;
    case '<':
      if (second == '>') return OperatorSign{"<>", Operator::not_equal, 3};
      if (second == '=') return OperatorSign{"<=", Operator::less_equal, 3};
      return OperatorSign{"<", Operator::less, 3};
    case '>':
      if (second == '=') return OperatorSign{">=", Operator::greater_equal, 3};
      return OperatorSign{">", Operator::greater, 3};
    case '&':
      if (second == '&') return OperatorSign{"&&", Operator::both, 2};
      return std::nullopt;
    case '|':
      if (second == '|') return OperatorSign{"||", Operator::either, binds_least};
      return std::nullopt;
    default:
      break;
  }
  for (const OperatorSign& sign : operator_words) {
    if (scanner.looking_at(sign.sign)) return sign;
  }
  return std::nullopt;
}

}  // namespace

Fault ExpressionReader::expression(Value& value) { return binary(binds_least, value) ? Fault{} : fault_; }

Fault ExpressionReader::operand(Value& value) {
  bool negative = false;
  if (scanner_.more() && (scanner_.peek() == '-' || scanner_.peek() == '+')) {
    negative = scanner_.peek() == '-';
    scanner_.advance();
  }
  if (!primary(value)) return fault_;
  if (negative) value.number = 0 - value.number;
  return {};
}

Fault ExpressionReader::variable_number(double& number) { return variable_index(number) ? Fault{} : fault_; }

bool ExpressionReader::binary(int lowest, Value& value) {
  if (!unary(value)) return false;
  while (scanner_.more()) {
    const auto sign = next_operator(scanner_);
    if (!sign || sign->binding < lowest) break;
    const std::uint16_t at = scanner_.offset();
    scanner_.advance(sign->sign.size());
    Value right;
    if (!binary(sign->binding + 1, right)) return false;
    double result = 0;
    const AlarmNumber number = apply(sign->operation, value, right, result);
    if (number != AlarmNumber::none) return fail(number, at);
    value = Value::of(result);
  }
  return true;
}

bool ExpressionReader::unary(Value& value) {
  // Signs are counted in a loop: a line of thousands of them must not deepen the stack.
  bool negative = false;
  bool negated = false;
  bool any = false;
  while (scanner_.more()) {
    const char c = scanner_.peek();
    if (c == '!' && !any) {
      negated = !negated;
      scanner_.advance();
      if (scanner_.more() && scanner_.peek() == '!')
        return fail(AlarmNumber::operand_missing, scanner_.offset());
      continue;
    }
    if (c != '-' && c != '+') break;
    any = true;
    negative ^= c == '-';
    scanner_.advance();
  }
  if (!primary(value)) return false;
  if (any) value = Value::of(negative ? 0 - value.number : value.number);
  if (negated) value = Value::of(value.number == 0 ? 1 : 0);
  return true;
}

bool ExpressionReader::primary(Value& value) {
  if (!scanner_.more()) return fail(AlarmNumber::operand_missing, scanner_.offset());
  const char c = scanner_.peek();
  if (c == '#') return variable(value);
  if (c == '[') return bracketed(value);
  if (letter(c) != '\0') return function(value);
  const std::uint16_t at = scanner_.offset();
  if (!is_digit(c) && c != '.') return fail(AlarmNumber::operand_missing, at);
  const Decimal decimal = scanner_.number();
  if (decimal.status == DecimalStatus::missing) return fail(AlarmNumber::operand_missing, at);
  if (decimal.status == DecimalStatus::too_large) return fail(AlarmNumber::number_range, at);
  value = Value::of(decimal.value);
  return true;
}

bool ExpressionReader::bracketed(Value& value) {
  const std::uint16_t at = scanner_.offset();
  scanner_.advance();
  if (++brackets_ > max_brackets) return fail(AlarmNumber::brackets_too_deep, at);
  if (!binary(binds_least, value)) return false;
  if (!scanner_.take(']')) return fail(AlarmNumber::bracket_open, at);
  --brackets_;
  return true;
}

bool ExpressionReader::variable(Value& value) {
  const std::uint16_t at = scanner_.offset();
  scanner_.advance();
  double number = 0;
  if (!variable_index(number)) return false;
  const AlarmNumber alarm = variables_.read(number, value);
  return alarm == AlarmNumber::none || fail(alarm, at);
}

bool ExpressionReader::variable_index(double& number) {
  const std::uint16_t at = scanner_.offset();
  if (!scanner_.more()) return fail(AlarmNumber::operand_missing, at);
  if (is_digit(scanner_.peek())) {
    std::uint32_t whole = 0;
    for (; !scanner_.at_end() && is_digit(scanner_.peek()); scanner_.advance()) {
      if (whole > 100000000) return fail(AlarmNumber::variable_unknown, at);
      whole = whole * 10 + static_cast<unsigned>(scanner_.peek() - '0');
    }
    number = whole;
    return true;
  }
  if (scanner_.peek() != '[') return fail(AlarmNumber::operand_missing, at);
  Value value;
  if (!bracketed(value)) return false;
  number = nearly_whole(value.number);
  if (number < 0 || number != std::floor(number)) return fail(AlarmNumber::variable_unknown, at);
  return true;
}

bool ExpressionReader::function(Value& value) {
  const std::uint16_t at = scanner_.offset();
  const std::size_t length = scanner_.letters();
  if (length == 2 && scanner_.take_word("PI")) {
    value = Value::of(std::numbers::pi);
    return true;
  }
  for (const FunctionName& entry : function_names) {
    if (std::string_view(entry.name).size() != length || !scanner_.take_word(entry.name)) continue;
    if (scanner_.more() && scanner_.peek() == '[') return call(entry.function, at, value);
    // NOT needs no bracket before a number or a variable.
    if (entry.function != Function::negation || scanner_.letters() != 0) break;
    if (!primary(value)) return false;
    value = Value::of(value.number == 0 ? 1 : 0);
    return true;
  }
  return fail(AlarmNumber::operand_missing, at);
}

// A bit or an axis behind the number, as Fanuc writes them, would be read as another expression.
bool ExpressionReader::parameter(const Value& of, std::uint16_t at, Value& value) {
  constexpr double highest = 999999;
  const double number = nearly_whole(of.number);
  Scanner ahead = scanner_;
  const bool axis = ahead.take('/') && ahead.more() && ahead.peek() == '[';
  double result = 0;
  if (axis || !of.given || !(number >= 0 && number <= highest) || number != std::floor(number))
    return fail(AlarmNumber::parameter_unavailable, at);
  const AlarmNumber alarm = variables_.read_parameter(static_cast<std::uint32_t>(number), result);
  value = Value::of(result);
  return alarm == AlarmNumber::none || fail(alarm, at);
}

bool ExpressionReader::call(Function function, std::uint16_t at, Value& value) {
  const std::uint16_t bracket = scanner_.offset();
  scanner_.advance();
  if (++brackets_ > max_brackets) return fail(AlarmNumber::brackets_too_deep, bracket);
  Value first;
  Value second;
  bool two = false;
  AlarmNumber alarm = AlarmNumber::none;
  if (function == Function::argument) {
    double number = 0;
    if (!scanner_.take('#')) return fail(AlarmNumber::operand_missing, bracket);
    if (!variable_index(number)) return false;
    alarm = variables_.argument(number, value);
  } else {
    if (!binary(binds_least, first)) return false;
    two = (function == Function::arc_tangent || function == Function::power) && scanner_.take(',');
    if (two && !binary(binds_least, second)) return false;
  }
  const bool of_machine = function == Function::parameter;
  if (of_machine && scanner_.more() && scanner_.peek() == ',')
    return fail(AlarmNumber::parameter_unavailable, at);
  if (!scanner_.take(']')) return fail(AlarmNumber::bracket_open, bracket);
  --brackets_;
  if (of_machine) return parameter(first, at, value);
  if (function == Function::arc_tangent && !two) {
    Scanner ahead = scanner_;
    two = ahead.take('/') && ahead.more() && ahead.peek() == '[';
    if (two) {
      scanner_ = ahead;
      if (!bracketed(second)) return false;
    }
  }
  if (function != Function::argument) {
    double result = 0;
    if (two) {
      alarm = apply(function, first.number, second.number, result);
    } else if (function == Function::power) {
      alarm = AlarmNumber::operand_missing;
    } else {
      alarm = apply(function, first.number, result);
    }
    value = Value::of(result);
  }
  return alarm == AlarmNumber::none || fail(alarm, at);
}

}  // namespace trunnion::language
