// SPDX-License-Identifier: Apache-2.0
// Bits and words of the register image by their addresses.
#pragma once

#include "memory.hpp"
#include "plc/library/register_names.hpp"
#include "plc/machine/register_area.hpp"

namespace trunnion::plc {

using st::Area;

using Address = st::RegisterAddress;
using st::interface_address;

/// Bits of one register of the area: 8, 16 or 32.
inline int width(Area area) { return st::info(area).bits; }

/// 0 or 1 of a bit, else the register's value; of one without sign below 2^16.
std::int32_t load(const Registers& registers, Address address);
/// A word saturates at the limits of its register.
void store(Registers& registers, Address address, std::int64_t value);

}  // namespace trunnion::plc
