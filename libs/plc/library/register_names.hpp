// SPDX-License-Identifier: Apache-2.0
// The names of the interface registers (registers.yaml).
#pragma once

#include <string>
#include <vector>

#include "plc/semantics/unit.hpp"

namespace trunnion::st {

struct NamedRegister {
  std::string name;  ///< as written
  RegisterAddress address;
  std::string unit;  ///< of display
};

/// Every register of the table, one by one. Throws std::runtime_error with file:line:column.
std::vector<NamedRegister> parse_register_table(const std::string& yaml, const std::string& file);
/// The interface that is compiled in.
const std::vector<NamedRegister>& register_table();
/// The same for Structured Text.
const RegisterNames& interface_registers();

extern const char* const registers_text;  ///< registers.yaml

}  // namespace trunnion::st
