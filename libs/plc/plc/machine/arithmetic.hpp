// SPDX-License-Identifier: Apache-2.0
// The arithmetic of the machine, as docs/plc.md states it: integers wrap around, REAL and LREAL are IEEE 754.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "plc/machine/instruction.hpp"

namespace trunnion::st {

inline float as_float(std::uint64_t cell) { return std::bit_cast<float>(static_cast<std::uint32_t>(cell)); }
inline double as_double(std::uint64_t cell) { return std::bit_cast<double>(cell); }
inline std::uint64_t cell_of(float value) { return std::bit_cast<std::uint32_t>(value); }
inline std::uint64_t cell_of(double value) { return std::bit_cast<std::uint64_t>(value); }
inline std::int64_t as_signed(std::uint64_t cell) { return static_cast<std::int64_t>(cell); }

inline constexpr std::uint16_t signed_flag = 128;

/// The value of the low bits, with sign or zeros extended.
inline std::uint64_t narrowed(std::uint64_t value, unsigned n) {
  const unsigned bits = n & 127u;
  if (bits >= 64) return value;
  const unsigned shift = 64 - bits;
  return (n & signed_flag) != 0
             ? static_cast<std::uint64_t>(static_cast<std::int64_t>(value << shift) >> shift)
             : (value << shift) >> shift;
}

/// The nearest integer of the type; saturates, NaN gives 0.
inline std::uint64_t saturated(double value, unsigned n) {
  const unsigned bits = n & 127u;
  if (std::isnan(value)) return 0;
  if ((n & signed_flag) != 0) {
    const double limit = std::ldexp(1.0, static_cast<int>(bits) - 1);
    const auto largest = static_cast<std::int64_t>((std::uint64_t{1} << (bits - 1)) - 1);
    if (value >= limit) return static_cast<std::uint64_t>(largest);
    if (value < -limit) return static_cast<std::uint64_t>(-largest - 1);
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  }
  if (value <= 0) return 0;
  if (value >= std::ldexp(1.0, static_cast<int>(bits)))
    return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  return static_cast<std::uint64_t>(value);
}

inline std::uint64_t shifted_left(std::uint64_t value, std::uint64_t count, unsigned bits) {
  return count >= bits ? 0 : narrowed(value << count, bits);
}
inline std::uint64_t shifted_right(std::uint64_t value, std::uint64_t count, unsigned bits) {
  return count >= bits ? 0 : value >> count;
}
inline std::uint64_t rotated_left(std::uint64_t value, std::uint64_t count, unsigned bits) {
  count %= bits;
  return count == 0 ? value : narrowed(value << count, bits) | (value >> (bits - count));
}

/// Binary coded decimals: four bits for each digit.
inline constexpr unsigned bcd_digits = 16, bcd_bits = 4;
inline std::uint64_t from_bcd(std::uint64_t digits) {
  std::uint64_t value = 0;
  for (unsigned i = bcd_digits; i-- > 0;) value = value * 10 + ((digits >> (i * bcd_bits)) & 15u);
  return value;
}
inline std::uint64_t to_bcd(std::uint64_t value) {
  std::uint64_t digits = 0;
  for (unsigned i = 0; i < bcd_digits; ++i, value /= 10) digits |= value % 10 << (i * bcd_bits);
  return digits;
}
inline bool is_bcd(std::uint64_t digits) {
  for (unsigned i = 0; i < bcd_digits; ++i)
    if (((digits >> (i * bcd_bits)) & 15u) > 9) return false;
  return true;
}

/// The bytes of the low bits in reverse order, with sign or zeros extended.
inline std::uint64_t bytes_swapped(std::uint64_t value, unsigned n) {
  const unsigned bits = n & 127u;
  return narrowed(__builtin_bswap64(value) >> (64 - bits), n);
}

template <class T>
T computed(MathFunction function, T x, T y) {
  switch (function) {
    case MathFunction::abs:
      return std::abs(x);
    case MathFunction::sqrt:
      return std::sqrt(x);
    case MathFunction::ln:
      return std::log(x);
    case MathFunction::log:
      return std::log10(x);
    case MathFunction::exp:
      return std::exp(x);
    case MathFunction::sin:
      return std::sin(x);
    case MathFunction::cos:
      return std::cos(x);
    case MathFunction::tan:
      return std::tan(x);
    case MathFunction::asin:
      return std::asin(x);
    case MathFunction::acos:
      return std::acos(x);
    case MathFunction::atan:
      return std::atan(x);
    case MathFunction::atan2:
      return std::atan2(x, y);
    case MathFunction::power:
      return std::pow(x, y);
    case MathFunction::trunc:
      return std::trunc(x);
    case MathFunction::floor:
      return std::floor(x);
    case MathFunction::ceil:
      return std::ceil(x);
    case MathFunction::count:
      break;
  }
  return x;
}

}  // namespace trunnion::st
