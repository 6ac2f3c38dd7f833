// SPDX-License-Identifier: Apache-2.0
// POINTER TO: the address of a variable, what is there (an entry of ByteCode::pointed) and an offset in bytes
// within it. Every use is checked against the variable. The bytes of a number are in the order of its value,
// the lowest first; those of a string end with a byte 0 that is the end of its text.
#pragma once

#include <cstdint>
#include <span>

#include "plc/machine/byte_code.hpp"
#include "plc/machine/fault.hpp"

namespace trunnion::st {

inline constexpr std::uint64_t null_pointer = std::uint64_t{1} << 63;

/// NULL of an address that no memory has, as a reference that is NULL is one.
std::uint64_t pointer_cell(std::uint64_t address, std::uint32_t entry);
/// The low 32 bits of `bytes` with their sign. NULL stays NULL, and so far outside that no variable has the
/// byte the offset stays where it is.
std::uint64_t pointer_moved(std::uint64_t pointer, std::uint64_t bytes);
/// 32 bits: variables that follow each other in memory have ascending numbers, each byte one of its own. 0 of
/// NULL.
std::uint64_t pointer_number(std::uint64_t pointer);
std::uint32_t pointer_address(std::uint64_t pointer);
std::int64_t pointer_offset(std::uint64_t pointer);

/// Op::point_load, point_save, point_cells. Without FaultKind::none nothing is written but the bytes of a
/// string before the one that is outside.
Fault use_pointer(const Instruction& in, std::span<const Pointed> table, std::span<std::uint64_t> memory,
                  std::uint64_t* frame);

}  // namespace trunnion::st
