// SPDX-License-Identifier: Apache-2.0
// The names of the interface registers (registers.yaml) for Structured Text.
#pragma once

#include <string>

#include "plc/semantics/unit.hpp"

namespace trunnion::st {

/// Throws std::runtime_error with file:line:column.
RegisterNames parse_register_names(const std::string& yaml, const std::string& file);
/// The interface that is compiled in.
const RegisterNames& interface_registers();

extern const char* const registers_text;  ///< registers.yaml

}  // namespace trunnion::st
