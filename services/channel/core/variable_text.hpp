// SPDX-License-Identifier: Apache-2.0
// Macro variables as text: what a new process of the channel needs of the one before.
#pragma once

#include <string>

#include "language/variables.hpp"

namespace trunnion::channel {

/// A line `boot ...` that names this start of the cluster (any text without a line end), then one line
/// `#number: value` for each variable that is not vacant, exact to the bit.
std::string write_variables(const language::VariableStore& variables, const std::string& boot);

/// Takes such a text over into `variables`; #50..#199 only when it was written in the same `boot`, for they
/// are forgotten at power-off. Throws std::runtime_error with file:line for what is no such line.
void read_variables(const std::string& text, const std::string& file, const std::string& boot,
                    language::VariableStore& variables);

}  // namespace trunnion::channel
