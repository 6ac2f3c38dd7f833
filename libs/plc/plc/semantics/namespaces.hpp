// SPDX-License-Identifier: Apache-2.0
// Namespaces (IEC 61131-3:2013, 6.9). Behind the parser every declaration gets its whole name, A.B.NAME, and
// every use of a name the whole name of what it means there; the rest of the translation knows no scopes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plc/semantics/unit.hpp"

namespace trunnion::st {

/// Nothing changes in sources without NAMESPACE and USING. `files`: names of the sources, for messages.
void resolve_names(SourceTree& tree, const RegisterNames& registers, const std::vector<std::string>& files,
                   Diagnostics& diagnostics);

/// Whether the namespace is `outer` or in it. Names in capitals; that of the global one is empty.
bool is_within(std::string_view space, std::string_view outer);

}  // namespace trunnion::st
