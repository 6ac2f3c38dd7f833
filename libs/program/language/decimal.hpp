// SPDX-License-Identifier: Apache-2.0
// Decimal numbers of programs: no exponent, an optional sign, digits with or without a point.
#pragma once

#include <cstdint>

namespace trunnion::language {

enum class DecimalStatus : std::uint8_t { ok, missing, too_large };

struct Decimal {
  DecimalStatus status = DecimalStatus::missing;
  double value = 0;           ///< the double nearest to the text
  bool point = false;         ///< the text has a decimal point
  const char* end = nullptr;  ///< first byte behind the number
};

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Largest magnitude of a number in a program.
inline constexpr double largest_number = 999999999.0;

/// Reads a number at `begin`. `5`, `5.`, `.5`, `+5` and `-.5` are numbers; a lone point or sign is missing.
Decimal read_decimal(const char* begin, const char* end);

}  // namespace trunnion::language
