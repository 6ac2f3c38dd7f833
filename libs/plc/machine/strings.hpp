// SPDX-License-Identifier: Apache-2.0
// The string functions of the machine (IEC 61131-3:2013, 6.6.2.5.11). Positions count bytes from 1.
#pragma once

#include <cstdint>
#include <span>

#include "plc/machine/instruction.hpp"

namespace trunnion::st {

/// Writes a string of at most `limit` bytes at the address in cells; longer results are cut off. False when
/// an address is outside the memory.
bool make_string(StringFunction function, std::span<std::uint64_t> memory, std::uint64_t result,
                 std::uint32_t limit, const std::uint64_t* arguments);
/// False as above.
bool query_string(StringFunction function, std::span<const std::uint64_t> memory,
                  const std::uint64_t* arguments, std::uint64_t& result);

}  // namespace trunnion::st
