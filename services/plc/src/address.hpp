// SPDX-License-Identifier: Apache-2.0
// Addresses of bits and words in the register image.
#pragma once

#include <optional>
#include <string_view>

#include "memory.hpp"
#include "plc/machine/register_area.hpp"

namespace trunnion::plc {

using st::Area;

struct Address {
  Area area = Area::x;
  std::uint16_t index = 0;
  std::int8_t bit = -1;  ///< -1: the whole register
  bool is_bit() const { return bit >= 0; }
  bool operator==(const Address&) const = default;
};

/// Bits of one register of the area: 8, 16 or 32.
inline int width(Area area) { return st::info(area).bits; }
/// X0.3, %G5, B7.31; nothing when it is no address or outside the image.
std::optional<Address> parse_address(std::string_view text);

/// 0 or 1 of a bit, else the register's value; of one without sign below 2^16.
std::int32_t load(const Registers& registers, Address address);
/// A word saturates at the limits of its register.
void store(Registers& registers, Address address, std::int64_t value);

}  // namespace trunnion::plc
