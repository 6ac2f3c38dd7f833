#include "language/expression.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

namespace trunnion::language {
namespace {

enum class Operator : std::uint8_t {
  multiply,
  divide,
  modulo,
  bit_and,
  add,
  subtract,
  bit_or,
  bit_xor,
  equal,
  not_equal,
  greater,
  greater_equal,
  less,
  less_equal,
  both,
  either,
};

struct OperatorSign {
  std::string_view sign;
  Operator operation;
  int binding;  // the higher, the sooner
};

constexpr int binds_least = 1;

// A longer sign stands before a shorter one that begins it.
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

constexpr double exact_integers = 9007199254740992.0;  // 2^53

AlarmNumber bits(Operator operation, double a, double b, double& result) {
  const auto whole = [](double v) { return v == std::floor(v) && std::abs(v) <= exact_integers; };
  if (!whole(a) || !whole(b)) return AlarmNumber::bits_of_fraction;
  const auto x = static_cast<std::int64_t>(a);
  const auto y = static_cast<std::int64_t>(b);
  result = static_cast<double>(operation == Operator::bit_and  ? x & y
                               : operation == Operator::bit_or ? x | y
                                                               : x ^ y);
  return AlarmNumber::none;
}

AlarmNumber apply(Operator operation, const Value& a, const Value& b, double& result) {
  const double x = a.number;
  const double y = b.number;
  switch (operation) {
    case Operator::multiply:
      result = x * y;
      break;
    case Operator::divide:
      if (y == 0) return AlarmNumber::division_by_zero;
      result = x / y;
      break;
    case Operator::modulo:
      if (y == 0) return AlarmNumber::division_by_zero;
      result = std::fmod(x, y);
      break;
    case Operator::add:
      result = x + y;
      break;
    case Operator::subtract:
      result = x - y;
      break;
    case Operator::bit_and:
    case Operator::bit_or:
    case Operator::bit_xor:
      return bits(operation, x, y, result);
    case Operator::equal:
      result = a.given == b.given && x == y ? 1 : 0;
      break;
    case Operator::not_equal:
      result = a.given != b.given || x != y ? 1 : 0;
      break;
    case Operator::greater:
      result = x > y ? 1 : 0;
      break;
    case Operator::greater_equal:
      result = x >= y ? 1 : 0;
      break;
    case Operator::less:
      result = x < y ? 1 : 0;
      break;
    case Operator::less_equal:
      result = x <= y ? 1 : 0;
      break;
    case Operator::both:
      result = x != 0 && y != 0 ? 1 : 0;
      break;
    case Operator::either:
      result = x != 0 || y != 0 ? 1 : 0;
      break;
  }
  return std::isfinite(result) ? AlarmNumber::none : AlarmNumber::result_too_large;
}

constexpr double degree = std::numbers::pi / 180;

// Whole quarters are taken off first, so that SIN[180] is 0 and COS[90] is 0.
double sine_of_degrees(double angle) {
  int quarters = 0;
  const double rest = std::remquo(angle, 90.0, &quarters) * degree;
  switch (static_cast<unsigned>(quarters) & 3u) {
    case 0:
      return std::sin(rest);
    case 1:
      return std::cos(rest);
    case 2:
      return -std::sin(rest);
    default:
      return -std::cos(rest);
  }
}

double cosine_of_degrees(double angle) {
  int quarters = 0;
  const double rest = std::remquo(angle, 90.0, &quarters) * degree;
  switch (static_cast<unsigned>(quarters) & 3u) {
    case 0:
      return std::cos(rest);
    case 1:
      return -std::sin(rest);
    case 2:
      return -std::cos(rest);
    default:
      return std::sin(rest);
  }
}

double full_circle(double y, double x) {
  const double angle = std::atan2(y, x) / degree;
  const double positive = angle < 0 ? angle + 360 : angle + 0.0;  // no negative zero
  return positive < 360 ? positive : 0;
}

AlarmNumber apply(Function function, double x, double& result) {
  constexpr AlarmNumber outside = AlarmNumber::function_domain;
  switch (function) {
    case Function::sine:
      result = sine_of_degrees(x);
      break;
    case Function::cosine:
      result = cosine_of_degrees(x);
      break;
    case Function::tangent: {
      const double cosine = cosine_of_degrees(x);
      if (cosine == 0) return outside;
      result = sine_of_degrees(x) / cosine;
      break;
    }
    case Function::arc_sine:
      if (std::abs(x) > 1) return outside;
      result = std::asin(x) / degree;
      break;
    case Function::arc_cosine:
      if (std::abs(x) > 1) return outside;
      result = std::acos(x) / degree;
      break;
    case Function::arc_tangent:
      result = std::atan(x) / degree;
      break;
    case Function::square_root:
      if (x < 0) return outside;
      result = std::sqrt(x);
      break;
    case Function::absolute:
      result = std::abs(x);
      break;
    case Function::round:
      result = std::round(x);
      break;
    case Function::fix:
    case Function::whole:
      result = std::trunc(x);
      break;
    case Function::fup:
      result = x < 0 ? std::floor(x) : std::ceil(x);
      break;
    case Function::logarithm:
      if (x <= 0) return outside;
      result = std::log(x);
      break;
    case Function::exponential:
      result = std::exp(x);
      break;
    case Function::sign:
      result = x > 0 ? 1 : x < 0 ? -1 : 0;
      break;
    case Function::negation:
      result = x == 0 ? 1 : 0;
      break;
    case Function::power:
    case Function::argument:
      break;
  }
  return std::isfinite(result) ? AlarmNumber::none : AlarmNumber::result_too_large;
}

AlarmNumber apply(Function function, double a, double b, double& result) {
  if (function == Function::arc_tangent) {
    if (a == 0 && b == 0) return AlarmNumber::function_domain;
    result = full_circle(a, b);
    return AlarmNumber::none;
  }
  result = std::pow(a, b);
  if (std::isnan(result) || (a == 0 && b < 0)) return AlarmNumber::function_domain;
  return std::isfinite(result) ? AlarmNumber::none : AlarmNumber::result_too_large;
}

}  // namespace

double nearly_whole(double number) {
  const double whole = std::round(number);
  return std::abs(number - whole) < 1e-9 ? whole : number;
}

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
  if (!scanner_.take(']')) return fail(AlarmNumber::bracket_open, bracket);
  --brackets_;
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
