#pragma once

#include <string>

#include "plc_core.hpp"

namespace trunnion::plc {

/// Compiles fast.il and main.il of the directory and loads them. Throws std::runtime_error with
/// file:line:column.
void load_programs(const std::string& directory, PlcCore& core);

/// Where in the state directory a standby PLC and the running one meet.
inline constexpr const char* rounds_file = "/plc.rounds";

}  // namespace trunnion::plc
