// SPDX-License-Identifier: Apache-2.0
// Macro variables as the topic that others read them by.
#pragma once

#include "contracts/types.hpp"
#include "language/variables.hpp"

namespace trunnion::channel {

/// Those that are not vacant, ascending.
idl::channel::Variables variable_message(const language::VariableStore& variables, std::uint16_t channel);

}  // namespace trunnion::channel
