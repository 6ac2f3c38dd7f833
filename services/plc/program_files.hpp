// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plc_core.hpp"

namespace trunnion::plc {

/// Compiles the tasks `fast` and `main` of the directory and loads them: of each either <task>.il or the
/// PROGRAM of this name in the .st files (*_test.st excepted), which are translated together. Returns
/// warnings. Throws std::runtime_error with a line file:line:column for each error.
std::vector<std::string> load_programs(const std::string& directory, PlcCore& core);

/// The file in the state directory by which the running PLC passes its rounds to a standby comparison.
inline constexpr const char* rounds_file = "/plc.rounds";

}  // namespace trunnion::plc
