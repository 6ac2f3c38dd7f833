// SPDX-License-Identifier: Apache-2.0
// PLCopen XML (TC6, version 2.01): types, variables and bodies in ladder diagram, function block diagram,
// instruction list and Structured Text, into the syntax tree of Structured Text.
#pragma once

#include <string_view>

#include "plc/plcopen/document.hpp"
#include "plc/syntax/ast.hpp"

namespace trunnion::st::plcopen {

/// Whether a file with this name is PLCopen XML.
bool is_plcopen(std::string_view name);
/// Adds what the document declares to `tree`, and to `places`, in the order of the document, what its
/// elements are. After an error it continues with the next element.
void import_document(std::string_view text, std::uint16_t file, SourceTree& tree, Diagnostics& diagnostics,
                     std::vector<ElementPlace>& places);

}  // namespace trunnion::st::plcopen
