// SPDX-License-Identifier: Apache-2.0
// Where a value is in the memory of the PLC, to be copied after a scan without allocation.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "address.hpp"
#include "contracts/types.hpp"
#include "plc/tools/variables.hpp"

namespace trunnion::plc {

struct ValuePlace {
  Address address;          ///< of a register
  std::uint32_t cell = 0;   ///< of the memory of the programs: below st::image_cells a register
  std::uint32_t cells = 1;  ///< of a string more than one
  std::uint16_t form = 0;   ///< of a register, for st::narrowed()
  bool is_register() const { return cell < st::image_cells; }
};

/// Of an elementary value or a string.
ValuePlace place_of(const st::Location& at);
/// Copies the value into the first `cells` of `to`, as idl::plc::ValueKind says.
void copy_value(const Memory& memory, const ValuePlace& place, std::span<std::uint64_t> to);
/// What clients need to show the value. Names that are too long for the contract are cut off.
idl::plc::VariableInfo info_of(const st::Location& at);

}  // namespace trunnion::plc
