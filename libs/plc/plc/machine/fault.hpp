// SPDX-License-Identifier: Apache-2.0
// Why a program was stopped.
#pragma once

#include <cstdint>
#include <string>

namespace trunnion::st {

enum class FaultKind : std::uint32_t {
  none,
  division,   ///< of integers by zero
  index,      ///< of an array
  range,      ///< of a subrange
  budget,     ///< more statements than permitted
  reference,  ///< an address outside the memory
  assertion,
  pointer,       ///< outside its variable
  pointed_type,  ///< a pointer to a variable of another type
};

/// Why a run has stopped before its end.
struct Fault {
  FaultKind kind = FaultKind::none;
  std::uint32_t instruction = 0;
  std::int64_t value = 0, low = 0, high = 0;  ///< of index, range and pointer
};

/// "division by zero", "index 12 is outside 0 .. 9" ...
std::string text_of(const Fault& fault);

}  // namespace trunnion::st
