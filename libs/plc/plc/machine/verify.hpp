// SPDX-License-Identifier: Apache-2.0
// Whether byte code can be run: every operand within its frame or table, no recursion, every loop counted.
#pragma once

#include <string>

#include "plc/machine/byte_code.hpp"

namespace trunnion::st {

/// Empty, or what is wrong with the code. Code that passes never leaves its memory and always ends within its
/// budget of statements, whatever the memory contains: addresses in cells are checked while it runs.
std::string verify(const ByteCode& code);

/// Routines that are active at once, of verified code.
std::uint32_t deepest_calls(const ByteCode& code);

}  // namespace trunnion::st
