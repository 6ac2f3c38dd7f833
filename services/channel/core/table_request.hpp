// SPDX-License-Identifier: Apache-2.0
// A table that the program changes (G10, system variables) as the request to its owner.
#pragma once

#include "contracts/types.hpp"
#include "language/canonical.hpp"

namespace trunnion::channel {

/// `command` is of kind table; `tools` is the table it changes. Lengths in mm.
idl::parameters::ParameterRequest table_request(const language::Command& command, std::uint16_t channel,
                                                const idl::parameters::ToolTable& tools);

}  // namespace trunnion::channel
