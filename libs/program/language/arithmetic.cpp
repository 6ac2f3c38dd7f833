// SPDX-License-Identifier: Apache-2.0
#include "language/arithmetic.hpp"

#include <cmath>
#include <numbers>

namespace trunnion::language {
namespace {

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

constexpr std::uint32_t decimal_digits = 8, bits_of_digit = 4;
constexpr double most_decimal = 99999999, most_coded = 4294967295.0;

/// Of a number whose digits in base `from` are those of the result in base `to`.
AlarmNumber change_base(double x, double highest, std::uint64_t from, std::uint64_t to, double& result) {
  if (!(x >= 0 && x <= highest) || x != std::floor(x)) return AlarmNumber::function_domain;
  std::uint64_t rest = static_cast<std::uint64_t>(x), place = 1, sum = 0;
  for (std::uint32_t digit = 0; digit < decimal_digits; ++digit, rest /= from, place *= to) {
    if (rest % from > 9) return AlarmNumber::function_domain;
    sum += rest % from * place;
  }
  result = static_cast<double>(sum);
  return AlarmNumber::none;
}

double full_circle(double y, double x) {
  const double angle = std::atan2(y, x) / degree;
  const double positive = angle < 0 ? angle + 360 : angle + 0.0;  // no negative zero
  return positive < 360 ? positive : 0;
}

}  // namespace

double nearly_whole(double number) {
  const double whole = std::round(number);
  return std::abs(number - whole) < 1e-9 ? whole : number;
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
    case Function::from_decimal_digits:
      return change_base(nearly_whole(x), most_coded, 1u << bits_of_digit, 10, result);
    case Function::to_decimal_digits:
      return change_base(nearly_whole(x), most_decimal, 10, 1u << bits_of_digit, result);
    case Function::with_point:
      result = x;
      break;
    case Function::power:
    case Function::argument:
    case Function::parameter:
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

}  // namespace trunnion::language
