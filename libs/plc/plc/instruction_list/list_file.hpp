// SPDX-License-Identifier: Apache-2.0
// Instruction lists in files of their own (docs/plc.md) into the syntax tree of Structured Text.
#pragma once

#include <string>
#include <string_view>

#include "plc/syntax/ast.hpp"
#include "plc/syntax/diagnostics.hpp"

namespace trunnion::st {

/// Whether a file with this name is an instruction list.
bool is_instruction_list(std::string_view name);
/// Adds the program of the list to `tree`. It has the name of the file.
void import_list(const std::string& name, std::string_view text, std::uint16_t file, SourceTree& tree,
                 Diagnostics& diagnostics);

}  // namespace trunnion::st
