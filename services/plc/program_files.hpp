// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plc_core.hpp"

namespace trunnion::plc {

/// Compiles fast.il and main.il of the directory and loads them. Throws std::runtime_error with
/// file:line:column.
void load_programs(const std::string& directory, PlcCore& core);

/// The file in the state directory by which the running PLC passes its rounds to a standby comparison.
inline constexpr const char* rounds_file = "/plc.rounds";

}  // namespace trunnion::plc
