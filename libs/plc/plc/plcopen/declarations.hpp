// SPDX-License-Identifier: Apache-2.0
// Types and variables of PLCopen XML as words of Structured Text.
#pragma once

#include "plc/plcopen/document.hpp"

namespace trunnion::st::plcopen {

/// The type that `holder` (type, baseType, returnType) contains; nothing when there is none that is known,
/// which is reported.
std::optional<Tokens> type_words(Document& document, Node holder, int depth = 0);
/// TYPE ... END_TYPE of `types/dataTypes`.
Tokens data_types(Document& document, Node types);
/// VAR ... END_VAR of a list of variables: inputVars, localVars, globalVars and so on.
Tokens variable_list(Document& document, Node list);

}  // namespace trunnion::st::plcopen
