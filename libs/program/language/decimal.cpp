// SPDX-License-Identifier: Apache-2.0
#include "language/decimal.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace trunnion::language {
namespace {

// Powers of ten up to 1e22 are exact in a double, and so is an integer up to 2^53; their quotient is one
// rounding.
constexpr std::array<double, 23> powers_of_ten = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                  1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int most_digits = 15;  // 10^15 < 2^53

}  // namespace

Decimal read_decimal(const char* begin, const char* end) {
  const char* p = begin;
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  const char* const digits_begin = p;
  std::uint64_t mantissa = 0;
  while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
  std::ptrdiff_t digits = p - digits_begin;
  std::ptrdiff_t fraction = 0;
  Decimal result;
  if (p != end && *p == '.') {
    result.point = true;
    const char* const fraction_begin = ++p;
    while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
    fraction = p - fraction_begin;
    digits += fraction;
  }
  if (digits == 0) {
    result.end = begin;
    return result;
  }
  result.end = p;
  double magnitude = 0;
  if (digits <= most_digits) {
    constexpr std::uint64_t exact_integers = 1ull << 53;
    static_assert(powers_of_ten.size() > most_digits && exact_integers > 1000000000000000ull);
    magnitude = static_cast<double>(mantissa) / powers_of_ten[static_cast<std::size_t>(fraction)];
  } else {
    const auto parsed = std::from_chars(digits_begin, p, magnitude, std::chars_format::fixed);
    // Out of range leaves the value alone: either it is far too small, which is 0, or far too large.
    if (parsed.ec == std::errc::result_out_of_range) {
      const char* first = digits_begin;
      while (first != p && *first == '0') ++first;
      magnitude = first != p && is_digit(*first) ? HUGE_VAL : 0.0;
    }
  }
  if (magnitude > largest_number) {
    result.status = DecimalStatus::too_large;
    return result;
  }
  result.status = DecimalStatus::ok;
  result.value = negative ? -magnitude : magnitude;
  return result;
}

}  // namespace trunnion::language
