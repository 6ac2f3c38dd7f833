// Macro variables that outlive the power: their text.
#pragma once

#include <string>

#include "language/variables.hpp"

namespace trunnion::channel {

/// One line `#number: value` for each kept variable (#500..#999, #50000..#54999) that is not vacant, exactly.
std::string write_kept_variables(const language::VariableStore& variables);

/// Takes such a text over into `variables`. Throws std::runtime_error with file:line for what is no such
/// line.
void read_kept_variables(const std::string& text, const std::string& file,
                         language::VariableStore& variables);

}  // namespace trunnion::channel
