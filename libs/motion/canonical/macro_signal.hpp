// SPDX-License-Identifier: Apache-2.0
// The signals that programs exchange with the programs of the PLC, 16 in each direction: #1000 to #1015 come
// from it and are one word in #1032, #1100 to #1115 go to it and are one word in #1132.
#pragma once

#include <cstdint>

namespace trunnion::canonical {

inline constexpr std::uint32_t macro_bits = 16;
inline constexpr std::uint32_t macro_input = 1000, macro_inputs = 1032;
inline constexpr std::uint32_t macro_output = 1100, macro_outputs = 1132;

/// Command::number of kind read, where the value is a signal from the PLC or to it.
constexpr bool is_macro_input(std::uint32_t number) {
  return number == macro_inputs || (number >= macro_input && number < macro_input + macro_bits);
}
/// Command::number of kind read or spindle_order, where it is a signal to the PLC.
constexpr bool is_macro_output(std::uint32_t number) {
  return number == macro_outputs || (number >= macro_output && number < macro_output + macro_bits);
}
constexpr bool is_macro_signal(std::uint32_t number) {
  return is_macro_input(number) || is_macro_output(number);
}

/// Of all its signals.
constexpr bool is_macro_word(std::uint32_t number) {
  return number == macro_inputs || number == macro_outputs;
}

constexpr std::uint32_t macro_bit(std::uint32_t number) {
  return number - (is_macro_input(number) ? macro_input : macro_output);
}

/// What variable `number` shows of the word of its direction: 0, 1 or 0 .. 65535.
constexpr std::uint16_t macro_value(std::uint32_t number, std::uint16_t word) {
  const std::uint32_t bits = word;
  return is_macro_word(number) ? word : static_cast<std::uint16_t>((bits >> macro_bit(number)) & 1u);
}

/// The word to the PLC after `value` was written to variable `number`; a word may be -32768 .. 65535.
constexpr std::uint16_t with_macro_output(std::uint16_t word, std::uint32_t number, std::int32_t value) {
  if (is_macro_word(number)) return static_cast<std::uint16_t>(value);
  const std::uint32_t bits = word, bit = 1u << macro_bit(number);
  return static_cast<std::uint16_t>(value != 0 ? bits | bit : bits & ~bit);
}

}  // namespace trunnion::canonical
