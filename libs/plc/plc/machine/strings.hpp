// SPDX-License-Identifier: Apache-2.0
// The string functions of the machine (IEC 61131-3:2013, 6.6.2.5.11). Positions count from 1: bytes, of
// `wide` strings characters, which are kept in UTF-8.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "plc/machine/instruction.hpp"

namespace trunnion::st {

/// Bytes of the first `count` characters.
std::size_t bytes_of_characters(std::string_view text, std::size_t count);
std::size_t characters(std::string_view text);
/// Whether WSTRING can have the text: well-formed UTF-8 without characters beyond 16 bits.
bool is_wide_text(std::string_view text);

/// Writes a string of at most `limit` bytes or characters at the address in cells; longer results are cut
/// off. False when an address is outside the memory.
bool make_string(StringFunction function, bool wide, std::span<std::uint64_t> memory, std::uint64_t result,
                 std::uint32_t limit, const std::uint64_t* arguments);
/// False as above.
bool query_string(StringFunction function, bool wide, std::span<const std::uint64_t> memory,
                  const std::uint64_t* arguments, std::uint64_t& result);

}  // namespace trunnion::st
