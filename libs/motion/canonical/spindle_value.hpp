// SPDX-License-Identifier: Apache-2.0
// What programs read of the spindles, and what they order. Spindles count from 0, in the order of their
// logical axis numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trunnion::canonical {

inline constexpr std::uint32_t most_spindles = 8;

enum class SpindleValue : std::uint8_t {
  homed,         ///< 1: its index mark was passed since the start
  synchronized,  ///< 1: it follows its master within 10a974
  master,        ///< number of the spindle it follows, from 1; 0 = none
  error,         ///< deg, where it should be less where it is
  reference,     ///< 1/min, signed: the speed its control is given
  angle,         ///< deg in [0, 360), clockwise from its index mark
  positioned,    ///< 1: its angle is controlled: M19, or the angles of a path
};
inline constexpr std::uint32_t spindle_values = 7;

/// Command::number of kind read.
constexpr std::uint32_t read_number(SpindleValue value, std::uint32_t spindle) {
  return static_cast<std::uint32_t>(value) * most_spindles + spindle;
}
constexpr SpindleValue read_value(std::uint32_t number) {
  return static_cast<SpindleValue>(number / most_spindles);
}
constexpr std::uint32_t read_spindle(std::uint32_t number) { return number % most_spindles; }

/// Command::number of kind spindle_order; of the first two for spindle 0, and so on. They are the external
/// parameters of NUM controls.
inline constexpr std::uint32_t order_angle = 0;         ///< value = deg, added to the angle of the master
inline constexpr std::uint32_t order_master = 94124;    ///< value = master_address + its number, or -1: none
inline constexpr std::uint32_t order_integral = 98024;  ///< value above 0 active, 0 none, below 0 frozen
inline constexpr std::uint32_t master_address = 24;     ///< of spindle 0

}  // namespace trunnion::canonical
