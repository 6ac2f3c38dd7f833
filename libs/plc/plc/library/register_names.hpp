// SPDX-License-Identifier: Apache-2.0
// The names of the interface registers (registers.yaml).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plc/semantics/unit.hpp"

namespace trunnion::st {

struct NamedRegister {
  std::string name;  ///< as written
  RegisterAddress address;
  std::string unit;                       ///< of display
  std::optional<RegisterAddress> before;  ///< where it was in versions up to 0.3
};

/// Every register of the table, one by one. Throws std::runtime_error with file:line:column.
std::vector<NamedRegister> parse_register_table(const std::string& yaml, const std::string& file);
/// The interface that is compiled in.
const std::vector<NamedRegister>& register_table();
/// What a program loses that still uses the address of a version before 0.4, for a warning; empty when the
/// address has a function now or never had one.
std::string moved_register(const RegisterAddress& address);
/// The same for Structured Text.
const RegisterNames& interface_registers();
/// Address of an interface register; throws std::out_of_range for a name that registers.yaml does not have.
RegisterAddress interface_address(const std::string& name);
RegisterAddress interface_address(const std::string& name, std::size_t index);

extern const char* const registers_text;  ///< registers.yaml

}  // namespace trunnion::st
