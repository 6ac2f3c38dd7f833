// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_expression.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "language/expression.hpp"

namespace trunnion::language {
namespace {

constexpr double equal_numbers = 1e-6;
constexpr std::uint32_t highest_parameter_number = 5601;
constexpr double degrees_of_radian = 57.295779513082320877;

enum class NgcOperator : std::uint8_t {
  power,
  multiply,
  divide,
  modulo,
  add,
  subtract,
  equal,
  not_equal,
  greater,
  greater_equal,
  less,
  less_equal,
  both,
  either,
  one_of_both,
};

struct NgcSign {
  std::string_view word;
  NgcOperator operation;
  int binding;  // the higher, the sooner
};
constexpr std::array ngc_words = {
    NgcSign{"MOD", NgcOperator::modulo, 4},       NgcSign{"EQ", NgcOperator::equal, 2},
    NgcSign{"NE", NgcOperator::not_equal, 2},     NgcSign{"GT", NgcOperator::greater, 2},
    NgcSign{"GE", NgcOperator::greater_equal, 2}, NgcSign{"LT", NgcOperator::less, 2},
    NgcSign{"LE", NgcOperator::less_equal, 2},    NgcSign{"AND", NgcOperator::both, 1},
    NgcSign{"OR", NgcOperator::either, 1},        NgcSign{"XOR", NgcOperator::one_of_both, 1},
};

/// Takes the operator that comes next, when it binds at least as `lowest` does.
std::optional<NgcSign> take_operator(LinuxcncScanner& scanner, int lowest) {
  LinuxcncScanner ahead = scanner;
  std::optional<NgcSign> found;
  if (ahead.take('*')) {
    found = ahead.take('*') ? NgcSign{"**", NgcOperator::power, 5} : NgcSign{"*", NgcOperator::multiply, 4};
  } else if (ahead.take('/')) {
    found = NgcSign{"/", NgcOperator::divide, 4};
  } else if (ahead.take('+')) {
    found = NgcSign{"+", NgcOperator::add, 3};
  } else if (ahead.take('-')) {
    found = NgcSign{"-", NgcOperator::subtract, 3};
  } else {
    for (const NgcSign& sign : ngc_words) {
      if (!ahead.take_word(sign.word)) continue;
      found = sign;
      break;
    }
  }
  if (!found || found->binding < lowest) return std::nullopt;
  scanner = ahead;
  return found;
}

double truth(bool holds) { return holds ? 1 : 0; }

AlarmNumber calculate(NgcOperator operation, double a, double b, double& result) {
  const bool equal = std::abs(a - b) < equal_numbers;
  switch (operation) {
    case NgcOperator::power:
      if (a < 0 && b != std::floor(b)) return AlarmNumber::function_domain;
      result = std::pow(a, b);
      break;
    case NgcOperator::multiply:
      result = a * b;
      break;
    case NgcOperator::divide:
      if (b == 0) return AlarmNumber::division_by_zero;
      result = a / b;
      break;
    case NgcOperator::modulo:
      if (b == 0) return AlarmNumber::division_by_zero;
      result = std::fmod(a, b);
      if (result < 0) result += std::abs(b);
      break;
    case NgcOperator::add:
      result = a + b;
      break;
    case NgcOperator::subtract:
      result = a - b;
      break;
    case NgcOperator::equal:
      result = truth(equal);
      break;
    case NgcOperator::not_equal:
      result = truth(!equal);
      break;
    case NgcOperator::greater:
      result = truth(a > b);
      break;
    case NgcOperator::greater_equal:
      result = truth(equal || a >= b);
      break;
    case NgcOperator::less:
      result = truth(a < b);
      break;
    case NgcOperator::less_equal:
      result = truth(equal || a <= b);
      break;
    case NgcOperator::both:
      result = truth(a != 0 && b != 0);
      break;
    case NgcOperator::either:
      result = truth(a != 0 || b != 0);
      break;
    case NgcOperator::one_of_both:
      result = truth((a != 0) != (b != 0));
      break;
  }
  return std::isfinite(result) ? AlarmNumber::none : AlarmNumber::result_too_large;
}

struct NgcFunction {
  std::string_view word;
  Function function;
};
// FIX and FUP are not those of the table: they round down and up.
constexpr std::array ngc_functions = {
    NgcFunction{"ABS", Function::absolute},  NgcFunction{"ACOS", Function::arc_cosine},
    NgcFunction{"ASIN", Function::arc_sine}, NgcFunction{"ATAN", Function::arc_tangent},
    NgcFunction{"COS", Function::cosine},    NgcFunction{"EXP", Function::exponential},
    NgcFunction{"FIX", Function::fix},       NgcFunction{"FUP", Function::fup},
    NgcFunction{"LN", Function::logarithm},  NgcFunction{"ROUND", Function::round},
    NgcFunction{"SIN", Function::sine},      NgcFunction{"SQRT", Function::square_root},
    NgcFunction{"TAN", Function::tangent},
};

}  // namespace

Fault LinuxcncExpression::whole(std::uint16_t at, double highest, std::uint32_t& result) {
  return whole_value(at, highest, result) ? Fault{} : fault_;
}

bool LinuxcncExpression::whole_value(std::uint16_t at, double highest, std::uint32_t& result) {
  double value = 0;
  if (!read_value(value)) return false;
  const double near = std::round(value);
  if (std::abs(value - near) > whole_enough) return fail(AlarmNumber::not_an_integer, at);
  if (!(near >= 0 && near <= highest)) return fail(AlarmNumber::value_range, at);
  result = static_cast<std::uint32_t>(near);
  return true;
}

bool LinuxcncExpression::binary(int lowest, double& result) {
  if (!read_value(result)) return false;
  for (;;) {
    const std::uint16_t at = scanner_.offset();
    const auto sign = take_operator(scanner_, lowest);
    if (!sign) return true;
    double right = 0;
    if (!binary(sign->binding + 1, right)) return false;
    double both = 0;
    const AlarmNumber alarm = calculate(sign->operation, result, right, both);
    if (alarm != AlarmNumber::none) return fail(alarm, at);
    result = both;
  }
}

bool LinuxcncExpression::read_value(double& result) {
  // Signs are counted in a loop: a line of thousands of them must not deepen the stack.
  bool negative = false;
  for (; scanner_.peek() == '-' || scanner_.peek() == '+'; scanner_.advance())
    negative ^= scanner_.peek() == '-';
  if (!unsigned_value(result)) return false;
  if (negative) result = 0 - result;
  return true;
}

bool LinuxcncExpression::unsigned_value(double& result) {
  const std::uint16_t at = scanner_.offset();
  if (scanner_.peek() == '[') return bracketed(result);
  if (scanner_.peek() == '#') {
    ParameterName parameter;
    scanner_.advance();
    if (!read_parameter(at, parameter)) return false;
    const Fault fault = read(parameter, result);
    return !fault || fail(fault.number, fault.offset, fault.detail);
  }
  if (scanner_.peek_letter() != '\0') return function(result);
  const Decimal decimal = scanner_.number();
  if (decimal.status == DecimalStatus::missing) return fail(AlarmNumber::operand_missing, at);
  if (decimal.status == DecimalStatus::too_large) return fail(AlarmNumber::number_range, at);
  result = decimal.value;
  return true;
}

bool LinuxcncExpression::bracketed(double& result) {
  const std::uint16_t at = scanner_.offset();
  if (!scanner_.take('[')) return fail(AlarmNumber::operand_missing, at, "needs [");
  if (++depth_ > max_brackets) return fail(AlarmNumber::brackets_too_deep, at);
  if (!binary(1, result)) return false;
  if (!scanner_.take(']')) return fail(AlarmNumber::bracket_open, at);
  --depth_;
  return true;
}

bool LinuxcncExpression::read_parameter(std::uint16_t at, ParameterName& result) {
  result = {};
  result.at = at;
  if (scanner_.take('<')) return read_name(result);
  if (++depth_ > max_brackets) return fail(AlarmNumber::brackets_too_deep, at);
  if (!whole_value(at, 1e8, result.number)) return false;
  --depth_;
  return true;
}

bool LinuxcncExpression::read_name(ParameterName& result) {
  NameHash hash;
  bool first = true;
  for (; scanner_.peek() != '>'; scanner_.advance()) {
    if (scanner_.at_end()) return fail(AlarmNumber::bracket_open, result.at);
    const char c = scanner_.peek();
    if (first) result.global = c == '_';
    first = false;
    // _ini[section]name and _hal[pin]
    if (c == '[')
      result.of_files = result.global && (hash.key() == name_key("_ini") || hash.key() == name_key("_hal"));
    hash.add(c);
  }
  scanner_.advance();
  result.name = hash.key();
  return true;
}

bool LinuxcncExpression::function(double& result) {
  const std::uint16_t at = scanner_.offset();
  if (scanner_.take_word("EXISTS")) return exists(result);
  for (const NgcFunction& row : ngc_functions) {
    if (!scanner_.take_word(row.word)) continue;
    double argument = 0;
    if (!bracketed(argument)) return false;
    AlarmNumber alarm = AlarmNumber::none;
    if (row.function == Function::arc_tangent) {
      double x = 0;
      if (!scanner_.take('/')) return fail(AlarmNumber::operand_missing, scanner_.offset(), "needs / and [");
      if (!bracketed(x)) return false;
      result = std::atan2(argument, x) * degrees_of_radian;
    } else if (row.function == Function::fix || row.function == Function::fup) {
      result = row.function == Function::fix ? std::floor(argument) : std::ceil(argument);
    } else {
      alarm = apply(row.function, argument, result);
    }
    return alarm == AlarmNumber::none || fail(alarm, at);
  }
  return fail(AlarmNumber::operand_missing, at);
}

bool LinuxcncExpression::exists(double& result) {
  const std::uint16_t at = scanner_.offset();
  if (!scanner_.take('[')) return fail(AlarmNumber::operand_missing, at, "needs [");
  const std::uint16_t place = scanner_.offset();
  if (!scanner_.take('#')) return fail(AlarmNumber::operand_missing, place, "needs #");
  ParameterName parameter;
  if (!read_parameter(place, parameter)) return false;
  if (!scanner_.take(']')) return fail(AlarmNumber::bracket_open, at);
  if (parameter.name == 0) {
    result = truth(parameter.number >= 1 && parameter.number <= highest_parameter_number);
    return true;
  }
  const auto* const predefined = parameter.global ? predefined_parameter(parameter.name) : nullptr;
  if (predefined != nullptr && predefined->value == LinuxcncValue::absent)
    return fail(AlarmNumber::linuxcnc_parameter_unavailable, place);
  result =
      truth(predefined != nullptr || variables_.names().find(parameter.name, parameter.global) != nullptr);
  return true;
}

Fault LinuxcncExpression::read(const ParameterName& parameter, double& result) const {
  if (parameter.name == 0) return {read_number(parameter.number, result), parameter.at};
  if (const double* const value = variables_.names().find(parameter.name, parameter.global)) {
    result = *value;
    return {};
  }
  if (parameter.of_files)
    return {AlarmNumber::linuxcnc_parameter_unavailable, parameter.at, "of an INI file or HAL"};
  const auto* const predefined = parameter.global ? predefined_parameter(parameter.name) : nullptr;
  if (predefined == nullptr) return {AlarmNumber::linuxcnc_name_missing, parameter.at};
  return {read_control(predefined->value, predefined->index, result), parameter.at};
}

AlarmNumber LinuxcncExpression::read_number(std::uint32_t number, double& result) const {
  if (number >= 1 && number <= last_user_parameter) {
    Value stored;
    const AlarmNumber alarm =
        variables_.read(number <= last_call_parameter ? number : number + user_parameter_distance, stored);
    result = stored.number;
    return alarm;
  }
  const NumberedParameter* const row = numbered_parameter(number);
  return row == nullptr ? AlarmNumber::variable_unknown
                        : read_control(row->value, number - row->first, result);
}

AlarmNumber LinuxcncExpression::read_control(LinuxcncValue which, std::uint32_t index, double& result) const {
  if (which == LinuxcncValue::returned) {
    result = variables_.names().returned();
    return AlarmNumber::none;
  }
  if (which == LinuxcncValue::has_returned) {
    result = truth(variables_.names().has_returned());
    return AlarmNumber::none;
  }
  return variables_.read_linuxcnc(which, index, result);
}

}  // namespace trunnion::language
