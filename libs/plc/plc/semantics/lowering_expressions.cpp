// SPDX-License-Identifier: Apache-2.0
// Operators.
#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "plc/machine/arithmetic.hpp"
#include "plc/machine/strings.hpp"
#include "plc/semantics/lowering.hpp"

namespace trunnion::st {
namespace {

bool is_number(Kind kind) {
  return is_integer(kind) || is_real(kind) || kind == Kind::integer_literal || kind == Kind::real_literal;
}

/// Whether evaluating it may stop the program or change a variable, so that it must not be evaluated in vain.
bool has_effect(const Expression& e) {
  if (e.kind == Expression::Kind::call || e.kind == Expression::Kind::index ||
      e.kind == Expression::Kind::dereference)
    return true;
  if (e.kind == Expression::Kind::binary && e.name == "/") return true;
  for (const auto& part : e.parts)
    if (part && has_effect(*part)) return true;
  return false;
}

bool calls(const Expression& e) {
  if (e.kind == Expression::Kind::call) return true;
  for (const auto& part : e.parts)
    if (part && calls(*part)) return true;
  return false;
}

}  // namespace

Value Lowering::expression(const Expression& e, const Type* expected) {
  switch (e.kind) {
    case Expression::Kind::integer:
      return literal_integer(e);
    case Expression::Kind::real: {
      auto value = constant_real(elementary(Kind::real_literal), 0);
      value.text = e.text;
      std::from_chars(e.text.data(), e.text.data() + e.text.size(), value.real);
      return value;
    }
    case Expression::Kind::boolean:
      return constant_integer(elementary(Kind::boolean), e.text == "1" ? 1 : 0);
    case Expression::Kind::string: {
      if (e.text.size() > longest_string)
        return failed(e.at, "a string has at most " + std::to_string(longest_string) + " bytes");
      Value value;
      const bool wide = e.base == 16;
      if (wide && !is_wide_text(e.text))
        return failed(e.at, "a WSTRING has characters of at most 16 bits, in UTF-8");
      const auto length = wide ? characters(e.text) : e.text.size();
      if (wide && length > longest_wide_string)
        return failed(e.at, "a WSTRING has at most " + std::to_string(longest_wide_string) + " characters");
      value.type = unit_.string_type(std::max<std::uint32_t>(1, static_cast<std::uint32_t>(length)), wide);
      value.is_constant = true;
      value.text = e.text;
      return value;
    }
    case Expression::Kind::time:
      return literal_time(e);
    case Expression::Kind::name:
      return name(e, expected);
    case Expression::Kind::direct: {
      const char* problem = "";
      const auto address = parse_register(e.name, &problem);
      if (!address) return failed(e.at, "'" + e.text + "': " + problem);
      unit_.warn_moved(*address, e.at);
      auto value = unit_.register_value(*address, nullptr, e.at);
      note_read(e, value);
      return value;
    }
    case Expression::Kind::member:
    case Expression::Kind::part:
    case Expression::Kind::index:
      return access(e);
    case Expression::Kind::dereference:
      return dereference(e);
    case Expression::Kind::unary:
      return unary(e, expected);
    case Expression::Kind::binary:
      return binary(e, expected);
    case Expression::Kind::call:
      return call(e, expected);
    case Expression::Kind::typed:
      return typed(e);
    case Expression::Kind::list:
    case Expression::Kind::structure:
      return failed(e.at, "a list of values is permitted as an initial value only");
  }
  return error();
}

Value Lowering::inverted(const Value& value, Position at) {
  if (value.type->kind == Kind::integer_literal)
    return failed(at, "NOT needs a typed literal, as WORD#16#FF");
  const auto given = as_bits(value, at);
  const auto kind = given.type->kind;
  if (!is_bits(kind)) return failed(at, "NOT is for BOOL and bit strings, not for " + value.type->name);
  const auto* type = elementary(kind);
  if (given.is_constant)
    return constant_integer(type, static_cast<std::int64_t>(
                                      narrowed(~static_cast<std::uint64_t>(value.integer), cell_form(kind))));
  const auto source = cell(given);
  auto result = temporary(type);
  emit_.add(kind == Kind::boolean ? Op::not_ : Op::invert, result.place.offset, source);
  if (kind != Kind::boolean && kind != Kind::lword)
    emit_.add(Op::narrow, result.place.offset, result.place.offset, 0, cell_form(kind));
  return result;
}

Value Lowering::unary(const Expression& e, const Type* expected) {
  auto value = expression(*e.parts[0], expected);
  if (value.is_error()) return value;
  if (e.name == "NOT") return inverted(value, e.at);
  if (!value.is_constant) value = as_number(value, e.at);
  if (unit_.is_codesys(e.at) && value.type->kind == Kind::udint) value.type = elementary(Kind::lint);
  const auto kind = value.type->kind;
  if (!is_number(kind) && !is_duration(kind))
    return failed(e.at, "'-' is for numbers and times, not for " + value.type->name);
  if (value.is_constant) {
    if (is_real(kind) || kind == Kind::real_literal) {
      value.real = -value.real;
      if (!value.text.empty()) value.text = value.text[0] == '-' ? value.text.substr(1) : "-" + value.text;
      return value;
    }
    const auto smallest = std::numeric_limits<std::int64_t>::min();
    if (value.large && value.integer != smallest)
      return failed(e.at, "the number is below -9223372036854775808");
    value.integer = value.integer == smallest ? smallest : -value.integer;
    value.large = false;
    if (kind != Kind::integer_literal && !fits(*value.type, value.integer))
      return failed(e.at, std::to_string(value.integer) + " is outside " + limits_text(*value.type) + " of " +
                              value.type->name);
    value.variable = nullptr;
    return value;
  }
  if (is_integer(kind) && !is_signed(kind))
    return failed(e.at, "'-' would leave " + value.type->name +
                            ", which has no negative values; convert to a signed type");
  const auto* type = elementary(kind);
  const auto source = cell(value);
  auto result = temporary(type);
  emit_.add(kind == Kind::real    ? Op::negate_f
            : kind == Kind::lreal ? Op::negate_d
                                  : Op::negate,
            result.place.offset, source);
  if (is_integer(kind) && bits(kind) < 64)
    emit_.add(Op::narrow, result.place.offset, result.place.offset, 0, cell_form(kind));
  return result;
}

Value Lowering::binary(const Expression& e, const Type* expected) {
  if (e.name == "AND" || e.name == "OR" || e.name == "XOR") return logic(e, expected);
  const bool compares = e.name.find_first_of("<>=") != std::string::npos;
  auto left = expression(*e.parts[0], compares ? nullptr : expected);
  if (calls(*e.parts[1])) left = kept(left);
  auto right = expression(*e.parts[1], compares && !left.is_error() ? left.type : expected);
  if (left.is_error() || right.is_error()) return error();
  emit_.place(e.at);
  if (e.name == "**") return power(left, right, expected, e.at);
  if (compares) return comparison(e.name, left, right, e.at);
  return arithmetic(e.name, left, right, e.at);
}

Value Lowering::logic(const Expression& e, const Type* expected) {
  auto left = expression(*e.parts[0], expected);
  const bool shortens = !left.is_error() && left.type->kind == Kind::boolean && e.name != "XOR" &&
                        !left.is_constant && has_effect(*e.parts[1]);
  if (shortens) {
    auto result = temporary(elementary(Kind::boolean));
    emit_.add(Op::move, result.place.offset, cell(left));
    const auto jump = emit_.add(e.name == "AND" ? Op::jump_if_not : Op::jump_if, 0, result.place.offset);
    const auto& boolean = *elementary(Kind::boolean);
    const auto right = converted(expression(*e.parts[1], &boolean), boolean, e.parts[1]->at);
    if (right.is_error()) return right;
    emit_.add(Op::move, result.place.offset, cell(right, boolean));
    emit_.jump_to_here(jump);
    return result;
  }
  auto right = expression(*e.parts[1], expected);
  if (left.is_error() || right.is_error()) return error();
  left = as_bits(left, e.at);
  right = as_bits(right, e.at);
  if (!settle(left, right, e.name, e.at)) return error();
  const auto kind = left.type->kind;
  if (!is_bits(kind))
    return failed(e.at, e.name + " is for BOOL and bit strings, not for " + left.type->name);
  const auto* type = elementary(kind);
  if (left.is_constant && right.is_constant) {
    const auto a = left.integer, b = right.integer;
    return constant_integer(type, e.name == "AND" ? a & b : e.name == "OR" ? a | b : a ^ b);
  }
  return operation(e.name == "AND"  ? Op::and_
                   : e.name == "OR" ? Op::or_
                                    : Op::xor_,
                   type, left, right, false);
}

/// Both get the type of the operation: a literal that of the other side, otherwise the common type.
bool Lowering::settle(Value& left, Value& right, const std::string& op, Position at) {
  if (left.is_literal() && right.is_literal()) {
    if (left.type->kind == right.type->kind) return true;
    const auto* type = elementary(Kind::real_literal);
    for (auto* side : {&left, &right})
      if (side->type->kind == Kind::integer_literal)
        *side =
            constant_real(type, side->large ? static_cast<double>(static_cast<std::uint64_t>(side->integer))
                                            : static_cast<double>(side->integer));
    return true;
  }
  if (left.is_literal() || right.is_literal()) {
    auto& literal = left.is_literal() ? left : right;
    const auto& other = left.is_literal() ? right : left;
    const auto* type = other.type->kind == Kind::enumeration ? other.type : elementary(other.type->kind);
    // A real literal beside an integer makes the operation one of LREAL or REAL.
    if (literal.type->kind == Kind::real_literal && is_integer(other.type->kind))
      type = widens(*other.type, *elementary(Kind::real)) ? elementary(Kind::real) : elementary(Kind::lreal);
    if (type == nullptr || type->kind == Kind::enumeration) {
      failed(at, "'" + op + "' between " + left.type->name + " and " + right.type->name + " is not defined");
      return false;
    }
    literal = converted(literal, *type, at);
    if (literal.is_error()) return false;
  }
  if (common_type(*left.type, *right.type) != nullptr) return true;
  std::string text =
      "'" + op + "' between " + left.type->name + " and " + right.type->name + " is not defined";
  const bool logical = left.type->kind == Kind::boolean || right.type->kind == Kind::boolean;
  if (left.type->kind < Kind::string && right.type->kind < Kind::string && !logical)
    text += "; convert one side, as with " + elementary(right.type->kind)->name + "_TO_" +
            elementary(left.type->kind)->name;
  failed(at, text);
  return false;
}

Value Lowering::operation(Op op, const Type* type, const Value& left, const Value& right, bool narrow) {
  const auto* common = common_type(*left.type, *right.type);
  const auto a = cell(left, *common), b = cell(right, *common);
  auto result = temporary(type);
  emit_.add(op, result.place.offset, a, b);
  if (narrow && bits(type->kind) < 64)
    emit_.add(Op::narrow, result.place.offset, result.place.offset, 0, cell_form(type->kind));
  return result;
}

Value Lowering::arithmetic(const std::string& op, Value left, Value right, Position at) {
  if (left.type->kind == Kind::pointer || right.type->kind == Kind::pointer)
    return pointer_arithmetic(op, left, right, at);
  mix(op, left, right, at);
  const auto timed = [](const Value& v) { return is_duration(v.type->kind) || is_date(v.type->kind); };
  if (timed(left) || timed(right)) return time_arithmetic(op, left, right, at);
  const auto bit_string = [&](const Value& v) { return is_bits(v.type->kind); };
  if (bit_string(left) || bit_string(right)) {
    const auto& one = bit_string(left) ? left : right;
    return failed(at, "'" + op + "' is for numbers, not for " + one.type->name + "; convert with " +
                          one.type->name + "_TO_" +
                          (bits(one.type->kind) <= 8    ? "USINT"
                           : bits(one.type->kind) == 16 ? "UINT"
                           : bits(one.type->kind) == 32 ? "UDINT"
                                                        : "ULINT"));
  }
  if (!is_number(left.type->kind) || !is_number(right.type->kind))
    return failed(at, "'" + op + "' is for numbers, not for " +
                          (is_number(left.type->kind) ? right.type->name : left.type->name) +
                          (left.type->kind == Kind::string ? "; strings are joined by CONCAT" : ""));
  if (!settle(left, right, op, at)) return error();
  const auto* type = left.is_literal() ? left.type : common_type(*left.type, *right.type);
  if (op == "MOD" && !is_integer(type->kind) && type->kind != Kind::integer_literal)
    return failed(at, "MOD is for integers, not for " + type->name);
  if (left.is_constant && right.is_constant) return folded(op, left, right, *type, at);
  const bool real = type->kind == Kind::real, lreal = type->kind == Kind::lreal;
  const bool is_unsigned = !is_signed(type->kind);
  if (op == "/" && right.is_constant && !real && !lreal && right.integer == 0)
    return failed(at, "division by zero");
  const Op code = op == "+"   ? (real    ? Op::add_f
                                 : lreal ? Op::add_d
                                         : Op::add)
                  : op == "-" ? (real    ? Op::subtract_f
                                 : lreal ? Op::subtract_d
                                         : Op::subtract)
                  : op == "*" ? (real    ? Op::multiply_f
                                 : lreal ? Op::multiply_d
                                         : Op::multiply)
                  : op == "/" ? (real          ? Op::divide_f
                                 : lreal       ? Op::divide_d
                                 : is_unsigned ? Op::divide_u
                                               : Op::divide)
                              : (is_unsigned ? Op::modulo_u : Op::modulo);
  return operation(code, type, left, right, is_integer(type->kind) && op != "MOD");
}

Value Lowering::folded(const std::string& op, const Value& left, const Value& right, const Type& type,
                       Position at) {
  if (is_real(type.kind) || type.kind == Kind::real_literal) {
    const auto value = [&](const Value& v) {
      return is_real(v.type->kind) || v.type->kind == Kind::real_literal ? v.real
                                                                         : static_cast<double>(v.integer);
    };
    const double a = value(left), b = value(right);
    if (type.kind == Kind::real) {
      const auto x = static_cast<float>(a), y = static_cast<float>(b);
      return constant_real(&type, static_cast<double>(op == "+"   ? x + y
                                                      : op == "-" ? x - y
                                                      : op == "*" ? x * y
                                                                  : x / y));
    }
    return constant_real(&type, op == "+" ? a + b : op == "-" ? a - b : op == "*" ? a * b : a / b);
  }
  const auto wide = [&](const Value& v) {
    return v.large || v.type->kind == Kind::ulint
               ? static_cast<__int128>(static_cast<std::uint64_t>(v.integer))
               : static_cast<__int128>(v.integer);
  };
  const auto a = wide(left), b = wide(right);
  if (op == "/" && b == 0) return failed(at, "division by zero");
  const auto result = op == "+"   ? a + b
                      : op == "-" ? a - b
                      : op == "*" ? a * b
                      : op == "/" ? a / b
                      : b == 0    ? 0
                                  : a % b;
  const bool large = result > std::numeric_limits<std::int64_t>::max();
  const bool outside =
      result < std::numeric_limits<std::int64_t>::min() || result > std::numeric_limits<std::uint64_t>::max();
  if (outside ||
      (type.kind != Kind::integer_literal && !fits(type, static_cast<std::int64_t>(result), large)))
    return failed(
        at, "the constant result is outside " +
                (type.kind == Kind::integer_literal ? "64 bits" : limits_text(type) + " of " + type.name));
  auto value = constant_integer(&type, static_cast<std::int64_t>(result));
  value.large = large;
  return value;
}

Value Lowering::time_arithmetic(const std::string& op, const Value& left, const Value& right, Position at) {
  const auto l = left.type->kind, r = right.type->kind;
  const auto undefined = [&] {
    return failed(at,
                  "'" + op + "' between " + left.type->name + " and " + right.type->name + " is not defined");
  };
  const Type* type = nullptr;
  const auto ltime = [&] {
    return elementary(l == Kind::ltime || r == Kind::ltime ? Kind::ltime : Kind::time);
  };
  if (is_duration(l) && is_duration(r) && (op == "+" || op == "-")) type = ltime();
  if ((l == Kind::tod || l == Kind::dt) && is_duration(r) && (op == "+" || op == "-")) type = left.type;
  if (is_date(l) && l == r && op == "-") type = elementary(Kind::time);
  if (type != nullptr) {
    if (left.is_constant && right.is_constant) {
      const auto sum = static_cast<std::uint64_t>(left.integer) +
                       (op == "+" ? static_cast<std::uint64_t>(right.integer)
                                  : 0 - static_cast<std::uint64_t>(right.integer));
      return constant_integer(type, static_cast<std::int64_t>(sum));
    }
    const auto a = cell(left), b = cell(right);
    auto result = temporary(type);
    emit_.add(op == "+" ? Op::add : Op::subtract, result.place.offset, a, b);
    return result;
  }
  if (!is_duration(l) || (op != "*" && op != "/") || !is_number(r)) return undefined();
  type = left.type;
  if (is_integer(r) || r == Kind::integer_literal) {
    if (op == "/" && right.is_constant && right.integer == 0) return failed(at, "division by zero");
    if (left.is_constant && right.is_constant) {
      std::int64_t product = 0;
      if (op == "/")
        return constant_integer(type, right.integer == -1 ? -left.integer : left.integer / right.integer);
      if (__builtin_mul_overflow(left.integer, right.integer, &product))
        return failed(at, "the time is longer than 292 years");
      return constant_integer(type, product);
    }
    const auto a = cell(left), b = cell(right);
    auto result = temporary(type);
    emit_.add(op == "*" ? Op::multiply : Op::divide, result.place.offset, a, b);
    return result;
  }
  const auto* lreal = elementary(Kind::lreal);
  const auto number = converted(right, *lreal, at);
  auto time = temporary(lreal);
  emit_.add(Op::int_to_d, time.place.offset, cell(left));
  auto product = operation(op == "*" ? Op::multiply_d : Op::divide_d, lreal, time, number, false);
  auto result = temporary(type);
  emit_.add(Op::d_round, result.place.offset, product.place.offset, 0, cell_form(Kind::lint));
  return result;
}

Value Lowering::comparison(const std::string& op, Value left, Value right, Position at) {
  const auto* boolean = elementary(Kind::boolean);
  if (!number_pointers(op, left, right, at)) return error();
  mix(op, left, right, at);
  if (left.type->kind == Kind::string && right.type->kind == Kind::string &&
      left.type->wide == right.type->wide)
    return string_comparison(op, left, right);
  if (left.type->kind == Kind::null_ && is_reference(right.type->kind)) std::swap(left, right);
  if (right.type->kind == Kind::null_ && is_reference(left.type->kind) && left.type->kind != Kind::null_)
    right = converted(right, *left.type, at);
  const bool elementary_values = (is_one_cell(left.type->kind) || left.is_literal()) &&
                                 (is_one_cell(right.type->kind) || right.is_literal());
  if (!elementary_values)
    return failed(
        at, "'" + op + "' is for elementary values, not for " +
                (is_one_cell(left.type->kind) || left.is_literal() ? right.type->name : left.type->name));
  if (!settle(left, right, op, at)) return error();
  if (left.is_constant && right.is_constant) return folded_comparison(op, left, right);
  const auto* type = common_type(*left.type, *right.type);
  if (type->kind == Kind::enumeration && op != "=" && op != "<>")
    return failed(at, "enumerated values are compared by = and <> only");
  if (is_reference(type->kind) && op != "=" && op != "<>")
    return failed(at, "references are compared by = and <> only");
  const bool swap = op == ">" || op == ">=";
  const auto& a = swap ? right : left;
  const auto& b = swap ? left : right;
  const bool real = type->kind == Kind::real, lreal = type->kind == Kind::lreal;
  if (op == "=" || op == "<>") {
    if (!real && !lreal) return operation(op == "=" ? Op::equal : Op::not_equal, boolean, a, b, false);
    auto result = operation(real ? Op::equal_f : Op::equal_d, boolean, a, b, false);
    if (op == "<>") emit_.add(Op::not_, result.place.offset, result.place.offset);
    return result;
  }
  const bool or_equal = op == ">=" || op == "<=";
  const bool is_unsigned = !is_signed(type->kind);
  const Op code = real          ? (or_equal ? Op::less_equal_f : Op::less_f)
                  : lreal       ? (or_equal ? Op::less_equal_d : Op::less_d)
                  : is_unsigned ? (or_equal ? Op::less_equal_u : Op::less_u)
                                : (or_equal ? Op::less_equal : Op::less);
  return operation(code, boolean, a, b, false);
}

Value Lowering::folded_comparison(const std::string& op, const Value& left, const Value& right) const {
  const auto real = [](const Value& v) {
    return is_real(v.type->kind) || v.type->kind == Kind::real_literal;
  };
  const auto decide = [&](auto a, auto b) {
    return op == "="    ? a == b
           : op == "<>" ? a != b
           : op == "<"  ? a < b
           : op == ">"  ? a > b
           : op == "<=" ? a <= b
                        : a >= b;
  };
  bool result = false;
  if (real(left) || real(right)) {
    const auto value = [&](const Value& v) { return real(v) ? v.real : static_cast<double>(v.integer); };
    result = decide(value(left), value(right));
  } else {
    const auto wide = [](const Value& v) {
      return v.large || (v.type->kind == Kind::ulint || v.type->kind == Kind::lword)
                 ? static_cast<__int128>(static_cast<std::uint64_t>(v.integer))
                 : static_cast<__int128>(v.integer);
    };
    result = decide(wide(left), wide(right));
  }
  return constant_integer(elementary(Kind::boolean), result ? 1 : 0);
}

Value Lowering::string_comparison(const std::string& op, const Value& left, const Value& right) {
  const auto a = address(left), b = address(right);
  const auto first = emit_.temporary(2);
  emit_.add(Op::move, first, a);
  emit_.add(Op::move, first + 1, b);
  auto order = temporary(elementary(Kind::lint));
  emit_.add(Op::string_query, order.place.offset, first, 0,
            static_cast<std::uint16_t>(StringFunction::compare));
  return comparison(op, order, constant_integer(elementary(Kind::integer_literal), 0), {});
}

Value Lowering::power(Value left, Value right, const Type* expected, Position at) {
  if (!is_number(left.type->kind) || !is_number(right.type->kind))
    return failed(at, "'**' is for numbers, not for " +
                          (is_number(left.type->kind) ? right.type->name : left.type->name));
  // The result has the type of the base when that is REAL, otherwise LREAL; a literal is a REAL for a REAL.
  const bool as_expected = left.is_literal() && expected != nullptr && expected->kind == Kind::real;
  const auto* type = elementary(left.type->kind == Kind::real || as_expected ? Kind::real : Kind::lreal);
  if (right.type->kind == Kind::lreal) type = elementary(Kind::lreal);
  const auto numeric = [&](Value v) {
    if (widens(*v.type, *type) || v.is_literal()) return converted(v, *type, at);
    return converted_to(v, *type, false, at);
  };
  const auto a = numeric(left), b = numeric(right);
  if (a.is_error() || b.is_error()) return error();
  const auto x = cell(a, *type), y = cell(b, *type);
  auto result = temporary(type);
  emit_.add(type->kind == Kind::real ? Op::math_f : Op::math, result.place.offset, x, y,
            static_cast<std::uint16_t>(MathFunction::power));
  return result;
}

}  // namespace trunnion::st
