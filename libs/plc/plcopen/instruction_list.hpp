// SPDX-License-Identifier: Apache-2.0
// Instruction List (IEC 61131-3:2003, 3.2) in PLCopen XML into words of Structured Text.
#pragma once

#include "plc/plcopen/document.hpp"

namespace trunnion::st::plcopen {

/// The statements of the body: each line one instruction, "label:" before it. The current result is gone at a
/// label; LD comes first there.
Tokens list_statements(Document& document, Node body);

}  // namespace trunnion::st::plcopen
